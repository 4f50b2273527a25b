// `npm run build:site`: gallery, reference, documents and rustdoc as static files, in build/site/. Examples in HTML are live below
// their text.

import { cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join, posix } from 'node:path';
import { build } from './build.mjs';
import { ROOT, UserError, filesOf, mustRun, printStep, runAsScript } from './process.mjs';
import { escapeHtml } from './tables.mjs';
import { ensurePackages, ensureNativeRust } from './toolchain.mjs';

const SITE_DIRECTORY = join(ROOT, 'build/site');
const { homepage } = JSON.parse(readFileSync(join(ROOT, 'package.json'), 'utf8'));
const SOURCES_URL = homepage.replace('#readme', '/blob/main/');

/** Texts of the links at the top of every page, by their addresses from the root of the site. */
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
const pagePathOf = (/** @type {string} */ path) => path.replace(/^README\.md$/, 'start.md').replace(/\bREADME\.md$/, 'index.md').replace(/md$/, 'html');

/** Returns a relative link from one page to another. */
const relativeLinkTo = (/** @type {string} */ page, /** @type {string} */ target) => '../'.repeat(page.split('/').length - 1) + target;

/** Returns the anchor of a heading, as GitHub makes it. */
const anchorOf = (/** @type {string} */ heading) => heading.toLowerCase().replace(/[^\p{L}\p{N} _-]/gu, '').replaceAll(' ', '-');

/** Returns the links at the top of a page. @param {string} page */
const navigationHtmlOf = (page) => {
  const linkHtmls = Object.entries(TOP_LINKS).map(([to, name]) => `<a href="${relativeLinkTo(page, to)}"${to === page ? ' aria-current="page"' : ''}>${name}</a>`);
  return `<nav class="site" aria-label="Site">${linkHtmls.join('\n')}\n<a href="${homepage}">Source</a></nav>`;
};

/** Returns the address that inline code in a document links to: a page of the site, or for a tag a page with this figure only. */
function linkAddressOf(/** @type {string} */ code, /** @type {string[]} */ figureTags) {
  if (code in TOP_LINKS) return code;
  const [, widget, attributeText] = code.match(/^<([a-z-]+)((?: [a-z-]+(?:="[^"]*")?)+)>$/) ?? [];
  if (!figureTags.includes(widget)) return undefined;
  const attributes = [...attributeText.matchAll(/([a-z-]+)(?:="([^"]*)")?/g)].map(([, name, value = '']) => [name, value]);
  return `embed.html?${new URLSearchParams([['widget', widget], ...attributes])}`;
}

/**
 * Returns the page of a document.
 *
 * @param {typeof import('marked')} marked
 * @param {string} document
 * @param {string[]} documents
 * @param {string[]} figureTags
 */
function renderPage({ Marked }, document, documents, figureTags) {
  const figurePattern = new RegExp(`<(${figureTags.join('|')})[^>]*>.*?</\\1>`, 'gs');
  const pagePath = pagePathOf(document);
  const siteLinkOf = (/** @type {string} */ href) => {
    if (/^(https?:|#)/.test(href)) return href;
    const [path, anchor] = href.split('#');
    const targetFile = posix.join(posix.dirname(document), path);
    return (documents.includes(targetFile) ? relativeLinkTo(pagePath, pagePathOf(targetFile)) : SOURCES_URL + targetFile) + (anchor ? `#${anchor}` : '');
  };
  const shownFigures = new Set();
  const markdown = readFileSync(join(ROOT, document), 'utf8');
  const documentHtml = new Marked({
    walkTokens: (token) => void (token.type === 'link' && (token.href = siteLinkOf(token.href))),
    renderer: {
      heading({ tokens, depth }) {
        const headingHtml = this.parser.parseInline(tokens);
        return `<h${depth} id="${anchorOf(this.parser.parseInline(tokens, this.parser.textRenderer))}">${headingHtml}</h${depth}>\n`;
      },
      image: ({ href, text }) => `<img src="${escapeHtml(href)}" alt="${escapeHtml(text)}">`,
      codespan({ text }) {
        const address = linkAddressOf(text, figureTags);
        const codeHtml = `<code>${escapeHtml(text)}</code>`;
        return address ? `<a href="${relativeLinkTo(pagePath, escapeHtml(address))}">${codeHtml}</a>` : codeHtml;
      },
      code({ text, lang }) {
        const liveFigures = lang === 'html' ? (text.match(figurePattern) ?? []).filter((figure) => !figure.includes('[') && !shownFigures.has(figure)) : [];
        for (const figure of liveFigures) shownFigures.add(figure);
        return `<pre><code>${escapeHtml(text)}</code></pre>\n${liveFigures.join('\n')}\n`;
      },
    },
  }).parse(markdown, { async: false });
  return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>${escapeHtml(markdown.match(/^# (.*)$/m)?.[1])}</title>
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

/** Throws if a page links to a missing file or heading. */
function checkLinks() {
  const siteFiles = new Set(filesOf('build/site'));
  const pagePaths = [...siteFiles].filter((path) => /^build\/site\/(?!rust|classroom).*html$/.test(path));
  const textByPage = new Map(pagePaths.map((path) => [path, readFileSync(join(ROOT, path), 'utf8')]));
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
  // The tags come from settings that the build writes.
  const { WIDGET_TAGS } = await import('./bundle.mjs');
  await ensurePackages('scripts');
  const rustTools = await ensureNativeRust();
  printStep('Documenting the crate');
  const docOptions = ['--quiet', '--locked', '--no-deps', '--lib', '--target-dir', join(ROOT, 'build/rustdoc')];
  await mustRun('The crate is not documented: see above.', join(rustTools.bin, 'cargo'), ['doc', ...docOptions], { env: rustTools.env });
  printStep('Rendering the documents');
  rmSync(SITE_DIRECTORY, { recursive: true, force: true });
  cpSync(join(ROOT, 'dist'), SITE_DIRECTORY, { recursive: true, filter: (path) => !/(\.d\.ts|\.map|cli\.js|motion-widgets\.js)$/.test(path) });
  cpSync(join(ROOT, 'build/rustdoc/doc'), join(SITE_DIRECTORY, 'rust'), { recursive: true });
  cpSync(join(ROOT, 'scripts/site.css'), join(SITE_DIRECTORY, 'site.css'));
  for (const path of ['index.html', 'reference.html']) {
    const pageHtml = readFileSync(join(SITE_DIRECTORY, path), 'utf8').replace('src="./motion-widgets.js"', 'src="./external.js"');
    writeFileSync(join(SITE_DIRECTORY, path), pageHtml.replace('</head>', '<link rel="stylesheet" href="./site.css" />\n</head>').replace(/<body[^>]*>/, `$&\n${navigationHtmlOf(path)}`));
  }
  const markedModule = await import('marked');
  const documentPaths = ['README.md', ...filesOf('doc').filter((path) => path.endsWith('.md'))];
  mkdirSync(join(SITE_DIRECTORY, 'doc/embedding'), { recursive: true });
  for (const documentPath of documentPaths) writeFileSync(join(SITE_DIRECTORY, pagePathOf(documentPath)), renderPage(markedModule, documentPath, documentPaths, WIDGET_TAGS));
  cpSync(join(ROOT, 'doc/morph.webp'), join(SITE_DIRECTORY, 'doc/morph.webp'));
  checkLinks();
  console.log('\nThe site is in build/site/.');
});
