// `npm run build:site`: gallery, reference, documents and rustdoc as static files, in build/site/. Examples in HTML are live below
// their text.

import { cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join, posix } from 'node:path';
import { build } from './build.mjs';
import { WIDGETS, filesOf } from './bundle.mjs';
import { ROOT, UserError, mustRun, printStep, runAsScript } from './process.mjs';
import { escapedHtml } from './tables.mjs';
import { ensurePackages, nativeRust } from './toolchain.mjs';

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

/** A figure with its content. */
const FIGURE_RE = new RegExp(`<(${WIDGETS.join('|')})[^>]*>.*?</\\1>`, 'gs');

/** Returns the address of the page of a document. */
const pageOf = (/** @type {string} */ path) => path.replace(/^README\.md$/, 'start.md').replace(/\bREADME\.md$/, 'index.md').replace(/md$/, 'html');

/** Returns a relative link from one page to another. */
const relativeLink = (/** @type {string} */ page, /** @type {string} */ target) => '../'.repeat(page.split('/').length - 1) + target;

/** Returns the anchor of a heading, as GitHub makes it. */
const anchorOf = (/** @type {string} */ heading) => heading.toLowerCase().replace(/[^\p{L}\p{N} _-]/gu, '').replaceAll(' ', '-');

/** @param {string} page */
const navigationHtml = (page) => {
  const links = Object.entries(TOP_LINKS).map(([to, name]) => `<a href="${relativeLink(page, to)}"${to === page ? ' aria-current="page"' : ''}>${name}</a>`);
  return `<nav class="site" aria-label="Site">${links.join('\n')}\n<a href="${homepage}">Source</a></nav>`;
};

/** Returns the address that inline code in a document links to: a page of the site, or for a tag a page with this figure only. */
function addressOf(/** @type {string} */ code) {
  if (code in TOP_LINKS) return code;
  const [, widget, attributeText] = code.match(/^<([a-z-]+)((?: [a-z-]+(?:="[^"]*")?)+)>$/) ?? [];
  if (!WIDGETS.includes(widget)) return undefined;
  const attributes = [...attributeText.matchAll(/([a-z-]+)(?:="([^"]*)")?/g)].map(([, name, value = '']) => [name, value]);
  return `embed.html?${new URLSearchParams([['widget', widget], ...attributes])}`;
}

/**
 * @param {typeof import('marked')} marked
 * @param {string} document
 * @param {string[]} documents
 * @returns {string} its page
 */
function renderedPage({ Marked }, document, documents) {
  const page = pageOf(document);
  const linkOf = (/** @type {string} */ href) => {
    if (/^(https?:|#)/.test(href)) return href;
    const [path, anchor] = href.split('#');
    const file = posix.join(posix.dirname(document), path);
    return (documents.includes(file) ? relativeLink(page, pageOf(file)) : SOURCES_URL + file) + (anchor ? `#${anchor}` : '');
  };
  const shownFigures = new Set();
  const text = readFileSync(join(ROOT, document), 'utf8');
  const html = new Marked({
    walkTokens: (token) => void (token.type === 'link' && (token.href = linkOf(token.href))),
    renderer: {
      heading({ tokens, depth }) {
        const headingHtml = this.parser.parseInline(tokens);
        return `<h${depth} id="${anchorOf(this.parser.parseInline(tokens, this.parser.textRenderer))}">${headingHtml}</h${depth}>\n`;
      },
      image: ({ href, text }) => `<img src="${escapedHtml(href)}" alt="${escapedHtml(text)}">`,
      codespan({ text }) {
        const address = addressOf(text);
        const code = `<code>${escapedHtml(text)}</code>`;
        return address ? `<a href="${relativeLink(page, escapedHtml(address))}">${code}</a>` : code;
      },
      code({ text, lang }) {
        const figures = lang === 'html' ? (text.match(FIGURE_RE) ?? []).filter((figure) => !figure.includes('[') && !shownFigures.has(figure)) : [];
        for (const figure of figures) shownFigures.add(figure);
        return `<pre><code>${escapedHtml(text)}</code></pre>\n${figures.join('\n')}\n`;
      },
    },
  }).parse(text, { async: false });
  return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>${escapedHtml(text.match(/^# (.*)$/m)?.[1])}</title>
<link rel="icon" href="data:,">
<link rel="stylesheet" href="${relativeLink(page, '')}page.css">
<link rel="stylesheet" href="${relativeLink(page, '')}motion-widgets.css">
<link rel="stylesheet" href="${relativeLink(page, '')}site.css">
${shownFigures.size > 0 ? `<script type="module" src="${relativeLink(page, '')}external.js"></script>` : ''}
</head>
<body>
${navigationHtml(page)}
<main class="document">
${html.replaceAll('<table>', '<table class="api">')}</main>
</body>
</html>
`;
}

/** Throws if a page links to a missing file or heading. */
function checkLinks() {
  const files = new Set(filesOf('build/site'));
  const ownPages = [...files].filter((path) => /^build\/site\/(?!rust|classroom).*html$/.test(path));
  const pages = new Map(ownPages.map((path) => [path, readFileSync(join(ROOT, path), 'utf8')]));
  const linkPattern = /\s(?:href|src)="(?!https?:|data:)([^"?#]*)[^"#]*#?([^"]*)"/g;
  const brokenLinks = [...pages].flatMap(([page, text]) => [...text.matchAll(linkPattern)].flatMap(([, path, anchor]) => {
    const target = path === '' ? page : posix.join(posix.dirname(page), path);
    const isFound = files.has(target) && (anchor === '' || !pages.has(target) || pages.get(target)?.includes(`id="${decodeURIComponent(anchor)}"`));
    return isFound ? [] : [`${page}: ${path}${anchor && `#${anchor}`}`];
  }));
  if (brokenLinks.length > 0) throw new UserError(`Links lead nowhere:\n${brokenLinks.join('\n')}`);
}

await runAsScript(import.meta.url, async () => {
  await build();
  await ensurePackages('scripts');
  const rust = await nativeRust();
  printStep('Documenting the crate');
  const docOptions = ['--quiet', '--locked', '--no-deps', '--lib', '--target-dir', join(ROOT, 'build/rustdoc')];
  await mustRun('The crate is not documented: see above.', join(rust.bin, 'cargo'), ['doc', ...docOptions], { env: rust.env });
  printStep('Rendering the documents');
  rmSync(SITE_DIRECTORY, { recursive: true, force: true });
  cpSync(join(ROOT, 'dist'), SITE_DIRECTORY, { recursive: true, filter: (path) => !/(\.d\.ts|\.map|cli\.js|motion-widgets\.js)$/.test(path) });
  cpSync(join(ROOT, 'build/rustdoc/doc'), join(SITE_DIRECTORY, 'rust'), { recursive: true });
  cpSync(join(ROOT, 'scripts/site.css'), join(SITE_DIRECTORY, 'site.css'));
  for (const path of ['index.html', 'reference.html']) {
    const text = readFileSync(join(SITE_DIRECTORY, path), 'utf8').replace('src="./motion-widgets.js"', 'src="./external.js"');
    writeFileSync(join(SITE_DIRECTORY, path), text.replace('</head>', '<link rel="stylesheet" href="./site.css" />\n</head>').replace(/<body[^>]*>/, `$&\n${navigationHtml(path)}`));
  }
  const marked = await import('marked');
  const documents = ['README.md', ...filesOf('doc').filter((path) => path.endsWith('.md'))];
  mkdirSync(join(SITE_DIRECTORY, 'doc/embedding'), { recursive: true });
  for (const document of documents) writeFileSync(join(SITE_DIRECTORY, pageOf(document)), renderedPage(marked, document, documents));
  cpSync(join(ROOT, 'doc/morph.webp'), join(SITE_DIRECTORY, 'doc/morph.webp'));
  checkLinks();
  console.log('\nThe site is in build/site/.');
});
