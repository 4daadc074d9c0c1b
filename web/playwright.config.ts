import { defineConfig } from '@playwright/test';

// Debian's Chromium; without a sandbox where the tests run as root, and without talking to anybody.
const chromium = {
  executablePath: process.env['CHROMIUM'] ?? '/usr/bin/chromium',
  args: [
    ...(process.getuid?.() === 0 ? ['--no-sandbox'] : []),
    '--disable-background-networking',
    '--disable-component-update',
    '--disable-quic',
    '--disable-sync',
    // WebGL without a graphics card.
    '--enable-unsafe-swiftshader',
    '--no-first-run',
    '--use-angle=swiftshader',
  ],
};

export default defineConfig({
  testDir: 'e2e',
  testMatch: '**/*.spec.ts',
  globalSetup: './e2e/support/global_setup.ts',
  workers: 1,
  // On a machine that is busy with other things a test may run out of time; what fails twice is broken. It says "flaky".
  retries: process.env['CI'] ? 1 : 0,
  forbidOnly: true,
  timeout: 60_000,
  expect: { timeout: 15_000 },
  reporter: 'list',
  use: {
    launchOptions: chromium,
    viewport: { width: 1280, height: 800 },
    contextOptions: { reducedMotion: 'reduce' },
    trace: 'retain-on-failure',
  },
});
