import { defineConfig } from 'vitest/config';
import { leanThree } from './scripts/lean_three';

// The daemon that `npm run dev` shows; everything that is not the dashboard's is asked there.
const daemon = process.env['RAYWATCH_URL'] ?? 'http://127.0.0.1:8420';

export default defineConfig({
  esbuild: { jsx: 'automatic', jsxImportSource: 'preact' },
  plugins: [leanThree()],
  build: {
    // scripts/build-dashboard names the directory beside the program.
    outDir: process.env['RAYWATCH_DASHBOARD_DIR'] ?? 'dist',
    emptyOutDir: true,
    target: 'es2022',
    // The daemon's content security policy allows no inline script and no data: script.
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
  },
  server: {
    proxy: Object.fromEntries(
      ['/api', '/healthz', '/readyz', '/metrics', '/openapi.json'].map((path) => [
        path,
        { target: daemon, headers: { origin: daemon } },
      ]),
    ),
  },
  test: { include: ['src/**/*.test.ts'] },
});
