import { spawnSync } from 'node:child_process';
import { existsSync } from 'node:fs';
import { resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

/** Where the program under test was built. */
export const kBuild = resolve(
  process.env['RAYWATCH_BUILD'] ?? fileURLToPath(new URL('../../../build/release', import.meta.url)),
);

/** The scans of a simulated yard that two sensors watch: a crate is taken, a bag is left, a person passes. Made once. */
export const kYard = resolve(kBuild, 'e2e-yard');
export const kYardScans = 14;

/** The scans of a pit from two stations, a night each from 1 March 2026 on, thin. Made once. */
export const kPit = resolve(kBuild, 'e2e-pit');

export function simulateYard(folder = kYard, more: readonly string[] = []): void {
  simulate('yard', folder, ['--scans', String(kYardScans), '--density', '0.3', '--interval-s', '30', ...more]);
}

export function simulatePit(folder = kPit, density = 0.12): void {
  simulate('pit', folder, ['--seed', '3', '--density', String(density), '--start', '2026-03-01T02:00:00Z']);
}

/** One scan of a room, as many times as dense as its usual scanner makes one; 113,000 points each. */
export function simulateLab(folder: string, density: number): void {
  simulate('lab', folder, ['--scans', '1', '--density', String(density)]);
}

function simulate(family: string, folder: string, options: readonly string[]): void {
  if (existsSync(resolve(folder, 'manifest.json'))) return;
  const made = spawnSync(resolve(kBuild, 'raywatch-simulate'), [family, '--output', folder, ...options], {
    stdio: ['ignore', 'ignore', 'inherit'],
  });
  if (made.status !== 0) throw new Error(`raywatch-simulate failed; is it built in ${kBuild}?`);
}
