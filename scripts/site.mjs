// `npm run build:site` writes gallery, reference, documents and rustdoc to build/site/, as static files. Examples in HTML are shown live
// below their text.

import { cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join, posix } from 'node:path';
import { build } from './build.mjs';
import { REPOSITORY_ROOT, UserError, filesOf, runOrThrow, printStep, runAsScript } from './process.mjs';
import { escapeHtml } from './tables.mjs';
import { ensurePackages, ensureNativeRust } from './toolchain.mjs';

const SITE_DIRECTORY = join(REPOSITORY_ROOT, 'build/site');
const { homepage } = JSON.parse(readFileSync(join(REPOSITORY_ROOT, 'package.json'), 'utf8'));
const SOURCES_URL = homepage.replace('#readme', '/blob/main/');

/** Texts of the links at the top of every page. Their keys are addresses relative to the root of the site. */
const TOP_LINKS = {
  'index.html': 'Figures',
  'start.html': 'Start',
  'doc/exercises.html': 'Exercises',
  'doc/embedding.html': 'Embedding',
  'reference.html': 'Elements',
  'doc/programming.html': 'JavaScript and Rust',
  'rust/motion/index.html': 'Crate',
  'doc/index.html': 'Documents',
};

/** Returns the address of the page of a document. */
const pagePathOf = (/** @type {string} */ documentPath) => documentPath.replace(/^README\.md$/, 'start.md').replace(/\bREADME\.md$/, 'index.md').replace(/md$/, 'html');

/** Returns a relative link from one page to another. */
const relativeLinkTo = (/** @type {string} */ pagePath, /** @type {string} */ targetPath) => '../'.repeat(pagePath.split('/').length - 1) + targetPath;

/** Returns the anchor of a heading, in the form that GitHub gives it. */
const anchorOf = (/** @type {string} */ headingText) => headingText.toLowerCase().replace(/[^\p{L}\p{N} _-]/gu, '').replaceAll(' ', '-');

/** Returns the links at the top of a page. @param {string} pagePath */
const navigationHtmlOf = (pagePath) => {
  const linkHtmls = Object.entries(TOP_LINKS).map(([linkPath, linkText]) => `<a href="${relativeLinkTo(pagePath, linkPath)}"${linkPath === pagePath ? ' aria-current="page"' : ''}>${linkText}</a>`);
  return `<nav class="site" aria-label="Site">${linkHtmls.join('\n')}\n<a href="${homepage}">Source</a></nav>`;
};

/** Returns the target of a link on inline code: a page of the site, or for an element's tag a page with only this figure. */
function linkAddressOf(/** @type {string} */ codeText, /** @type {string[]} */ figureTags) {
  if (codeText in TOP_LINKS) return codeText;
  const [, widgetTag, attributeText] = codeText.match(/^<([a-z-]+)((?: [a-z-]+(?:="[^"]*")?)+)>$/) ?? [];
  if (!figureTags.includes(widgetTag)) return undefined;
  const attributePairs = [...attributeText.matchAll(/([a-z-]+)(?:="([^"]*)")?/g)].map(([, attributeName, attributeText = '']) => [attributeName, attributeText]);
  return `embed.html?${new URLSearchParams([['widget', widgetTag], ...attributePairs])}`;
}

/**
 * Returns the page of a document.
 *
 * @param {typeof import('marked')} marked
 * @param {string} documentPath
 * @param {string[]} documentPaths
 * @param {string[]} figureTags
 */
function renderPage({ Marked }, documentPath, documentPaths, figureTags) {
  const figurePattern = new RegExp(`<(${figureTags.join('|')})[^>]*>.*?</\\1>`, 'gs');
  const pagePath = pagePathOf(documentPath);
  const siteLinkOf = (/** @type {string} */ documentLink) => {
    if (/^(https?:|#)/.test(documentLink)) return documentLink;
    const [linkedPath, linkAnchor] = documentLink.split('#');
    const targetFile = posix.join(posix.dirname(documentPath), linkedPath);
    return (documentPaths.includes(targetFile) ? relativeLinkTo(pagePath, pagePathOf(targetFile)) : SOURCES_URL + targetFile) + (linkAnchor ? `#${linkAnchor}` : '');
  };
  const shownFigures = new Set();
  const markdownText = readFileSync(join(REPOSITORY_ROOT, documentPath), 'utf8');
  const documentHtml = new Marked({
    walkTokens: (markdownToken) => void (markdownToken.type === 'link' && (markdownToken.href = siteLinkOf(markdownToken.href))),
    renderer: {
      heading({ tokens, depth }) {
        const headingHtml = this.parser.parseInline(tokens);
        return `<h${depth} id="${anchorOf(this.parser.parseInline(tokens, this.parser.textRenderer))}">${headingHtml}</h${depth}>\n`;
      },
      image: ({ href, text }) => `<img src="${escapeHtml(href)}" alt="${escapeHtml(text)}">`,
      codespan({ text }) {
        const siteAddress = linkAddressOf(text, figureTags);
        const codeHtml = `<code>${escapeHtml(text)}</code>`;
        return siteAddress ? `<a href="${relativeLinkTo(pagePath, escapeHtml(siteAddress))}">${codeHtml}</a>` : codeHtml;
      },
      code({ text, lang }) {
        const liveFigures = lang === 'html' ? (text.match(figurePattern) ?? []).filter((figureHtml) => !figureHtml.includes('[') && !shownFigures.has(figureHtml)) : [];
        for (const figureHtml of liveFigures) shownFigures.add(figureHtml);
        return `<pre><code>${escapeHtml(text)}</code></pre>\n${liveFigures.join('\n')}\n`;
      },
    },
  }).parse(markdownText, { async: false });
  return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>${escapeHtml(markdownText.match(/^# (.*)$/m)?.[1])}</title>
<link rel="icon" href="data:,">
<link rel="stylesheet" href="${relativeLinkTo(pagePath, '')}page.css">
<link rel="stylesheet" href="${relativeLinkTo(pagePath, '')}motion-widgets.css">
<link rel="stylesheet" href="${relativeLinkTo(pagePath, '')}site.css">
${shownFigures.size > 0 ? `<script type="module" src="${relativeLinkTo(pagePath, '')}external.js"></script>` : ''}
</head>
<body>
${navigationHtmlOf(pagePath)}
<main class="document">
${documentHtml.replaceAll('<table>', '<table class="api">')}</main>
</body>
</html>
`;
}

/** Throws an error if a page links to a missing file or heading. */
function checkLinks() {
  const siteFiles = new Set(filesOf('build/site'));
  const pagePaths = [...siteFiles].filter((path) => /^build\/site\/(?!rust|classroom).*html$/.test(path));
  const textByPage = new Map(pagePaths.map((path) => [path, readFileSync(join(REPOSITORY_ROOT, path), 'utf8')]));
  const linkPattern = /\s(?:href|src)="(?!https?:|data:)([^"?#]*)[^"#]*#?([^"]*)"/g;
  const brokenLinks = [...textByPage].flatMap(([page, text]) => [...text.matchAll(linkPattern)].flatMap(([, path, anchor]) => {
    const targetPath = path === '' ? page : posix.join(posix.dirname(page), path);
    const isFound = siteFiles.has(targetPath) && (anchor === '' || !textByPage.has(targetPath) || textByPage.get(targetPath)?.includes(`id="${decodeURIComponent(anchor)}"`));
    return isFound ? [] : [`${page}: ${path}${anchor && `#${anchor}`}`];
  }));
  if (brokenLinks.length > 0) throw new UserError(`Links lead nowhere:\n${brokenLinks.join('\n')}`);
}

await runAsScript(import.meta.url, async () => {
  await build();
  // bundle.mjs reads the elements' names from a file that the build writes. It is therefore imported after the build.
  const { WIDGET_TAGS } = await import('./bundle.mjs');
  await ensurePackages('scripts');
  const rustTools = await ensureNativeRust();
  printStep('Documenting the crate');
  const docOptions = ['--quiet', '--locked', '--no-deps', '--lib', '--target-dir', join(REPOSITORY_ROOT, 'build/rustdoc')];
  await runOrThrow('The crate is not documented: see above.', join(rustTools.cargoDirectory, 'cargo'), ['doc', ...docOptions], { env: rustTools.env });
  printStep('Rendering the documents');
  rmSync(SITE_DIRECTORY, { recursive: true, force: true });
  cpSync(join(REPOSITORY_ROOT, 'dist'), SITE_DIRECTORY, { recursive: true, filter: (path) => !/(\.d\.ts|\.map|cli\.js|motion-widgets\.js)$/.test(path) });
  cpSync(join(REPOSITORY_ROOT, 'build/rustdoc/doc'), join(SITE_DIRECTORY, 'rust'), { recursive: true });
  cpSync(join(REPOSITORY_ROOT, 'scripts/site.css'), join(SITE_DIRECTORY, 'site.css'));
  for (const path of ['index.html', 'reference.html']) {
    const pageHtml = readFileSync(join(SITE_DIRECTORY, path), 'utf8').replace('src="./motion-widgets.js"', 'src="./external.js"');
    writeFileSync(join(SITE_DIRECTORY, path), pageHtml.replace('</head>', '<link rel="stylesheet" href="./site.css" />\n</head>').replace(/<body[^>]*>/, `$&\n${navigationHtmlOf(path)}`));
  }
  const markedLibrary = await import('marked');
  const documentPaths = ['README.md', ...filesOf('doc').filter((path) => path.endsWith('.md'))];
  mkdirSync(join(SITE_DIRECTORY, 'doc/embedding'), { recursive: true });
  for (const documentPath of documentPaths) writeFileSync(join(SITE_DIRECTORY, pagePathOf(documentPath)), renderPage(markedLibrary, documentPath, documentPaths, WIDGET_TAGS));
  cpSync(join(REPOSITORY_ROOT, 'doc/morph.webp'), join(SITE_DIRECTORY, 'doc/morph.webp'));
  checkLinks();
  console.log('\nThe site is in build/site/.');
});
