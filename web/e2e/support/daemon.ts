// The real daemon, on a free port with a store of its own.

import { type ChildProcess, spawn } from 'node:child_process';
import { once } from 'node:events';
import { cp, mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { kBuild, kYard } from './build';

interface SideCar {
  captured_at: string;
  sensor: string;
  pose: { position_m: number[]; orientation_xyzw: number[] };
}

export class Daemon {
  url = '';
  private process: ChildProcess | undefined;
  private constructor(private readonly folder: string) {}

  /** Starts one, with a copy of another's store if that is given. */
  static async start(store?: string): Promise<Daemon> {
    const daemon = new Daemon(await mkdtemp(join(tmpdir(), 'raywatch-e2e-')));
    await writeFile(join(daemon.folder, 'raywatch.toml'), '[watch]\nlearn_scans = 2\n');
    if (store) await cp(store, daemon.store, { recursive: true });
    await daemon.run('127.0.0.1:0');
    return daemon;
  }

  get store(): string {
    return join(this.folder, 'store');
  }

  private async run(listen: string): Promise<void> {
    const config = join(this.folder, 'raywatch.toml');
    const process = spawn(
      join(kBuild, 'raywatch'),
      ['serve', '--config', config, '--data-dir', this.store, '--listen', listen],
      { stdio: ['ignore', 'ignore', 'pipe'] },
    );
    this.process = process;
    let log = '';
    await new Promise<void>((resolve, reject) => {
      process.stderr.on('data', (piece: Buffer) => {
        log += piece.toString();
        const url = /listening on (http[^,]*),/.exec(log)?.[1];
        if (!url) return;
        this.url = url;
        resolve();
      });
      process.once('exit', () => reject(new Error(`the daemon did not start:\n${log}`)));
    });
  }

  async stop(): Promise<void> {
    const process = this.process;
    if (!process) return;
    this.process = undefined;
    const ended = once(process, 'exit');
    process.kill('SIGTERM');
    await ended;
  }

  /** Starts it again at the same address with the same store. */
  async startAgain(): Promise<void> {
    await this.run(new URL(this.url).host);
  }

  /** Ends it and forgets its store. */
  async end(): Promise<void> {
    await this.stop();
    await rm(this.folder, { recursive: true, force: true });
  }

  async get<T>(path: string): Promise<T> {
    const response = await fetch(this.url + path);
    if (!response.ok) throw new Error(`${path}: ${await response.text()}`);
    return (await response.json()) as T;
  }

  async post<T>(path: string, body: object): Promise<T> {
    const response = await fetch(this.url + path, {
      method: 'POST',
      headers: { 'Content-Type': 'application/json' },
      body: JSON.stringify(body),
    });
    if (!response.ok) throw new Error(`${path}: ${await response.text()}`);
    return (await response.json()) as T;
  }

  /** The yard with its two sensors, and rules beside the one that every site has. */
  async makeYard(): Promise<void> {
    await this.post('/api/v1/sites', { name: 'yard', profile: 'outdoor', time_zone: 'Europe/Berlin' });
    for (const name of ['yard-1', 'yard-2']) await this.post('/api/v1/sensors', { name, site: 'yard' });
    const persistence = { scans: 2, of: 3 };
    const rules = [
      { name: 'nothing leaves', kinds: ['removed'], severity: 'critical' },
      { name: 'large things', min_extent_m: 0.2, severity: 'advisory' },
    ];
    for (const rule of rules) await this.post('/api/v1/rules', { site: 'yard', persistence, ...rule });
  }

  /** Uploads scans of the simulated yard, and waits for their comparisons. */
  async upload(first: number, end: number, folder = kYard): Promise<void> {
    for (let number = first; number < end; ++number) {
      const file = join(folder, `yard_${String(number).padStart(4, '0')}.pcd`);
      const sideCar = JSON.parse(await readFile(`${file}.json`, 'utf8')) as SideCar;
      const query = new URLSearchParams({
        sensor: sideCar.sensor,
        captured_at: sideCar.captured_at,
        pose: [...sideCar.pose.position_m, ...sideCar.pose.orientation_xyzw].join(','),
      });
      const response = await fetch(`${this.url}/api/v1/scans?${query}`, {
        method: 'POST',
        headers: { Prefer: 'wait=30', 'Content-Type': 'application/octet-stream' },
        body: (await readFile(file)) as unknown as BodyInit,
      });
      if (!response.ok) throw new Error(`${file}: ${await response.text()}`);
    }
  }
}
