// After the build: writes each file's compressed forms beside it, and holds the whole dashboard to its budget.
import { readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { extname, join } from 'node:path';
import { brotliCompressSync, constants, gzipSync } from 'node:zlib';

const directory = process.env.RAYWATCH_DASHBOARD_DIR ?? 'dist';
const budgetBytes = 250_000; // everything, compressed with gzip, chunks that load later included
const compressible = new Set(['.css', '.html', '.js', '.json', '.svg', '.txt']);

let total = 0;
const rows = [];
/** The files below a folder; by hand, as the first releases of Node 18 list one folder only. */
const filesBelow = (folder) =>
  readdirSync(join(directory, folder), { withFileTypes: true }).flatMap((entry) =>
    entry.isDirectory() ? filesBelow(join(folder, entry.name)) : [join(folder, entry.name)],
  );

for (const name of filesBelow('').sort()) {
  const file = join(directory, name);
  if (!compressible.has(extname(file))) continue;
  const content = readFileSync(file);
  const gzip = gzipSync(content, { level: 9 });
  const brotli = brotliCompressSync(content, { params: { [constants.BROTLI_PARAM_QUALITY]: 11 } });
  if (gzip.length < content.length) writeFileSync(`${file}.gz`, gzip);
  if (brotli.length < content.length) writeFileSync(`${file}.br`, brotli);
  total += gzip.length;
  rows.push(
    `${String(content.length).padStart(8)} ${String(gzip.length).padStart(8)} ${String(brotli.length).padStart(8)}  ${name}`,
  );
}
console.log(`   bytes     gzip   brotli\n${rows.join('\n')}`);
console.log(`dashboard: ${(total / 1000).toFixed(1)} kB with gzip, of ${budgetBytes / 1000} kB`);
if (total > budgetBytes) {
  console.error('The dashboard is larger than its budget: load less, or load it smaller.');
  process.exit(1);
}
