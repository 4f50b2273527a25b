// `npm run build:site` writes gallery, reference, documents and rustdoc to build/site/, as static files.

import { cpSync, readFileSync, rmSync } from 'node:fs';
import { join, posix } from 'node:path';
import { buildProject } from './build.mjs';
import { REPOSITORY_ROOT, UserError, filesOf, runOrThrow, printStep, runAsScript } from './process.mjs';
import { ensureNativeRust } from './toolchain.mjs';

const SITE_DIRECTORY = 'build/site';

/** Throws an error if a page links to a missing file or heading. */
function checkLinks() {
  const siteFiles = new Set(filesOf(SITE_DIRECTORY));
  const pagePaths = [...siteFiles].filter((filePath) => /^build\/site\/(?!rust|classroom).*html$/.test(filePath));
  const textByPage = new Map(pagePaths.map((filePath) => [filePath, readFileSync(join(REPOSITORY_ROOT, filePath), 'utf8')]));
  const linkPattern = /\s(?:href|src)="(?!https?:|data:)([^"?#]*)[^"#]*#?([^"]*)"/g;
  const brokenLinks = [...textByPage].flatMap(([pagePath, text]) => [...text.matchAll(linkPattern)].flatMap(([, filePath, headingAnchor]) => {
    const targetPath = filePath === '' ? pagePath : posix.join(posix.dirname(pagePath), filePath);
    const isFound = siteFiles.has(targetPath) && (headingAnchor === '' || !textByPage.has(targetPath) || textByPage.get(targetPath)?.includes(`id="${decodeURIComponent(headingAnchor)}"`));
    return isFound ? [] : [`${pagePath}: ${filePath}${headingAnchor && `#${headingAnchor}`}`];
  }));
  if (brokenLinks.length > 0) throw new UserError(`Links lead nowhere:\n${brokenLinks.join('\n')}`);
}

await runAsScript(import.meta.url, async () => {
  await buildProject();
  // pages.mjs reads the elements' names from a file that the build writes. It is therefore imported after the build.
  const { MAIN_PAGES, writePages } = await import('./pages.mjs');
  const rustTools = await ensureNativeRust();
  printStep('Documenting the crate');
  const docOptions = ['--quiet', '--locked', '--no-deps', '--lib', '--target-dir', join(REPOSITORY_ROOT, 'build/rustdoc')];
  await runOrThrow('The crate is not documented: see above.', join(rustTools.cargoDirectory, 'cargo'), ['doc', ...docOptions], { env: rustTools.env });
  printStep('Rendering the documents');
  const sitePathOf = (/** @type {string} */ filePath) => join(REPOSITORY_ROOT, SITE_DIRECTORY, filePath);
  rmSync(sitePathOf(''), { recursive: true, force: true });
  cpSync(join(REPOSITORY_ROOT, 'dist'), sitePathOf(''), { recursive: true, filter: (filePath) => !/(\.d\.ts|\.map|cli\.js|motion-widgets\.js)$/.test(filePath) });
  cpSync(join(REPOSITORY_ROOT, 'build/rustdoc/doc'), sitePathOf('rust'), { recursive: true });
  cpSync(join(REPOSITORY_ROOT, 'doc/morph.webp'), sitePathOf('doc/morph.webp'));
  const documentPaths = filesOf('doc').filter((filePath) => filePath.endsWith('.md'));
  const documentPages = Object.fromEntries(documentPaths.map((filePath) => [filePath, filePath.replace(/\bREADME\.md$/, 'index.md').replace(/md$/, 'html')]));
  await writePages(SITE_DIRECTORY, { ...documentPages, 'README.md': 'start.html', ...MAIN_PAGES }, true);
  checkLinks();
  console.log('\nThe site is in build/site/.');
});
