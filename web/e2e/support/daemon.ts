// The real daemon, on a free port with a store of its own.

import { type ChildProcess, spawn } from 'node:child_process';
import { once } from 'node:events';
import { cp, mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { kBuild, kPit, kYard } from './build';

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

  /** The pit, which a schedule has surveyed: a first night, one with a result, one without scans, another, and none. */
  async makePit(folder = kPit, cell_m = 4): Promise<void> {
    await this.post('/api/v1/sites', { name: 'pit', profile: 'survey', time_zone: 'Australia/Perth', epsg: 28350 });
    for (const name of ['pit-1', 'pit-2']) await this.post('/api/v1/sensors', { name, site: 'pit' });
    const polygon_m = [
      [-26, -80],
      [30, -80],
      [30, 80],
      [-26, 80],
    ];
    const zone = { site: 'pit', name: 'bench', kind: 'volume', z_min_m: -1, z_max_m: 40, polygon_m };
    const { id } = await this.post<{ id: number }>('/api/v1/zones', zone);
    for (const night of [0, 1, 3]) await this.upload(2 * night, 2 * night + 2, folder, 'pit');
    const levels = { figure: 'cut_m3', zone: id, yellow: 200, orange: 1000, red: 20000 };
    await this.post('/api/v1/schedules', {
      site: 'pit',
      name: 'nightly',
      cron: '0 13 1-5 3 *',
      since: '2026-03-01T00:00:00Z',
      catch_up: 'all',
      grace_s: 0,
      survey: { zones: [id], cell_m, core_spacing_m: cell_m, density_t_per_m3: 2.65, thresholds: [levels] },
    });
    await this.until<{ items: { state: string }[] }>(
      '/api/v1/schedules/1/runs',
      ({ items }) => items.length === 5 && items.every(({ state }) => state !== 'queued' && state !== 'running'),
    );
  }

  /** Asks until the answer is as it shall be. */
  async until<T>(path: string, holds: (answer: T) => boolean): Promise<void> {
    while (!holds(await this.get<T>(path))) await new Promise((resolve) => setTimeout(resolve, 100));
  }

  /** Uploads scans of a simulated place, and waits for their comparisons. */
  async upload(first: number, end: number, folder = kYard, family = 'yard'): Promise<void> {
    for (let number = first; number < end; ++number) {
      const file = join(folder, `${family}_${String(number).padStart(4, '0')}.pcd`);
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
