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

export function simulateYard(folder = kYard, more: readonly string[] = []): void {
  if (existsSync(resolve(folder, 'manifest.json'))) return;
  const made = spawnSync(
    resolve(kBuild, 'raywatch-simulate'),
    ['yard', '--output', folder, '--scans', String(kYardScans), '--density', '0.3', '--interval-s', '30', ...more],
    { stdio: ['ignore', 'ignore', 'inherit'] },
  );
  if (made.status !== 0) throw new Error(`raywatch-simulate failed; is it built in ${kBuild}?`);
}
