// SPDX-License-Identifier: MIT
// Bundles study.js into dist/charts.min.js, and gathers the licences of all that went into it in dist/LICENSES.
import { build } from 'esbuild';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';

const { metafile } = await build({
    entryPoints: ['study.js'], outfile: 'dist/charts.min.js', bundle: true, minify: true, format: 'iife', target: 'es2020',
    charset: 'ascii', legalComments: 'none', metafile: true,
});

const bundled = Object.entries(Object.values(metafile.outputs)[0].inputs).filter(([, { bytesInOutput }]) => bytesInOutput > 0);
const folders = new Set(bundled.map(([file]) => file.match(/^node_modules\/(@[^/]+\/)?[^/]+/)?.[0]).filter(Boolean));
const licences = [...folders].sort().map((folder) => {
    const { name, version, license } = JSON.parse(readFileSync(`${folder}/package.json`, 'utf8'));
    const file = ['LICENSE', 'LICENSE.md', 'LICENSE.txt', 'license'].map((f) => `${folder}/${f}`).find(existsSync);
    if (!file) throw new Error(`${name} has no file with its licence`);
    return `${name} ${version} (${license})\n\n${readFileSync(file, 'utf8').trim()}\n`;
});
writeFileSync('dist/LICENSES', licences.join(`\n${'-'.repeat(78)}\n\n`));
