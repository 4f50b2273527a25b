// Pages of documents: Markdown rendered to HTML, with the examples of figures shown live below their text.

import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join, posix } from 'node:path';
import { Lexer, Marked } from 'marked';
import { settings } from '../build/settings.js';
import { REPOSITORY_ROOT } from './process.mjs';
import { escapeHtml, insertTables } from './tables.mjs';

const { homepage } = JSON.parse(readFileSync(join(REPOSITORY_ROOT, 'package.json'), 'utf8'));
const SOURCES_URL = homepage.replace('#readme', '/blob/main/');

const FIGURE_TAGS = Object.keys(settings);
const FIGURE_PATTERN = new RegExp(`<(${FIGURE_TAGS.join('|')})[^>]*>.*?</\\1>`, 'gs');

/** Paths of the pages in dist/, by the path of their document. */
export const MAIN_PAGES = { 'www/index.md': 'index.html', 'doc/embedding/figures.md': 'reference.html' };

/** Texts of the links at the top of every page of the site. Their keys are addresses relative to the root of the site. */
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

/**
 * Writes the pages of documents.
 *
 * @param {string} siteDirectory relative to the root of the repository
 * @param {Record<string, string>} pagePaths paths in that directory, by the path of their document
 * @param {boolean} [hasNavigation] true for links to the other pages of the site at the top
 */
export async function writePages(siteDirectory, pagePaths, hasNavigation = false) {
  for (const [documentPath, pagePath] of Object.entries(pagePaths)) {
    const filePath = join(REPOSITORY_ROOT, siteDirectory, pagePath);
    mkdirSync(dirname(filePath), { recursive: true });
    writeFileSync(filePath, await insertTables(renderPage(documentPath, pagePaths, hasNavigation)));
  }
}

/** Returns the links at the top of a page. @param {(sitePath: string) => string} linkTo @param {string} pagePath */
function navigationHtmlOf(linkTo, pagePath) {
  const linkHtmls = Object.entries(TOP_LINKS).map(([linkPath, linkText]) => `<a href="${linkTo(linkPath)}"${linkPath === pagePath ? ' aria-current="page"' : ''}>${linkText}</a>`);
  return `<nav class="site" aria-label="Site">${linkHtmls.join('\n')}\n<a href="${homepage}">Source</a></nav>\n`;
}

/** Returns the address to which inline code of a document links: a page of the site or, if the code is the tag of a figure, a page that shows only that figure. */
function linkAddressOf(/** @type {string} */ codeText) {
  if (codeText in TOP_LINKS) return codeText;
  const [, widgetTag, attributeText] = codeText.match(/^<([a-z-]+)((?: [a-z-]+(?:="[^"]*")?)+)>$/) ?? [];
  if (!FIGURE_TAGS.includes(widgetTag)) return undefined;
  const attributePairs = [...attributeText.matchAll(/([a-z-]+)(?:="([^"]*)")?/g)].map(([, attributeName, attributeText = '']) => [attributeName, attributeText]);
  return `embed.html?${new URLSearchParams([['widget', widgetTag], ...attributePairs])}`;
}

/** Returns a button that sets the state of a figure, from a line with the button's label and the state. @param {string} buttonLine @param {(label: string) => string} renderInline */
function tryButtonHtmlOf(buttonLine, renderInline) {
  const [, buttonLabel, buttonState] = /** @type {RegExpExecArray} */ (/^(.+) (\{.*\})$/.exec(buttonLine));
  return `<button data-try="${escapeHtml(buttonState)}">${renderInline(buttonLabel)}</button>`;
}

/** Returns the page of a document. @param {string} documentPath @param {Record<string, string>} pagePaths @param {boolean} hasNavigation */
function renderPage(documentPath, pagePaths, hasNavigation) {
  const pagePath = pagePaths[documentPath];
  const linkTo = (/** @type {string} */ sitePath) => '../'.repeat(pagePath.split('/').length - 1) + sitePath;
  const linkTargetOf = (/** @type {string} */ documentLink) => {
    if (/^(https?:|#)/.test(documentLink)) return documentLink;
    const [linkedPath, linkAnchor] = documentLink.split('#');
    const targetFile = posix.join(posix.dirname(documentPath), linkedPath);
    return (targetFile in pagePaths ? linkTo(pagePaths[targetFile]) : SOURCES_URL + targetFile) + (linkAnchor ? `#${linkAnchor}` : '');
  };
  const usedAnchors = new Set();
  const shownFigures = new Set();
  const markdownText = readFileSync(join(REPOSITORY_ROOT, documentPath), 'utf8');
  const documentHtml = /** @type {string} */ (new Marked({
    walkTokens: (markdownToken) => void (markdownToken.type === 'link' && (markdownToken.href = linkTargetOf(markdownToken.href))),
    renderer: {
      heading({ tokens, depth: headingDepth }) {
        // The anchor has the form that GitHub gives it. Of several equal headings, the first has an anchor.
        const headingText = this.parser.parseInline(tokens, this.parser.textRenderer).replaceAll(/<[^>]*>/g, '');
        const headingAnchor = headingText.toLowerCase().replace(/[^\p{L}\p{N} _-]/gu, '').replaceAll(' ', '-');
        const idAttribute = usedAnchors.has(headingAnchor) ? '' : ` id="${headingAnchor}"`;
        usedAnchors.add(headingAnchor);
        return `<h${headingDepth}${idAttribute}>${this.parser.parseInline(tokens)}</h${headingDepth}>\n`;
      },
      image: ({ href, text: sourceText }) => `<img src="${escapeHtml(href)}" alt="${escapeHtml(sourceText)}">`,
      codespan({ text: sourceText }) {
        const siteAddress = linkAddressOf(sourceText);
        const codeHtml = `<code>${escapeHtml(sourceText)}</code>`;
        return siteAddress ? `<a href="${linkTo(escapeHtml(siteAddress))}">${codeHtml}</a>` : codeHtml;
      },
      code({ text: sourceText, lang }) {
        if (lang === 'try') return `<p>${sourceText.split('\n').map((buttonLine) => tryButtonHtmlOf(buttonLine, (buttonLabel) => this.parser.parseInline(Lexer.lexInline(buttonLabel)))).join('\n')}</p>\n`;
        const liveFigures = lang === 'html' ? (sourceText.match(FIGURE_PATTERN) ?? []).filter((figureHtml) => !figureHtml.includes('[') && !shownFigures.has(figureHtml)) : [];
        for (const figureHtml of liveFigures) shownFigures.add(figureHtml);
        return `<pre><code>${escapeHtml(sourceText)}</code></pre>\n${liveFigures.join('\n')}\n`;
      },
    },
  }).parse(markdownText, { async: false }));
  const scriptNames = documentHtml.match(FIGURE_PATTERN) ? ['page', 'external', 'de'] : [];
  const description = documentHtml.match(/<p>(.*?)<\/p>/s)?.[1].replaceAll(/<[^>]*>/g, '');
  return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>${escapeHtml(markdownText.match(/^# (.*)$/m)?.[1])}</title>
<meta name="description" content="${description}">
<link rel="icon" href="data:,">
${['page', 'motion-widgets'].map((fileName) => `<link rel="stylesheet" href="${linkTo(fileName)}.css">`).join('\n')}
${scriptNames.map((fileName) => `<script type="module" src="${linkTo(fileName)}.js"></script>`).join('\n')}
</head>
<body>
${hasNavigation ? navigationHtmlOf(linkTo, pagePath) : ''}<main>
${documentHtml}</main>
</body>
</html>
`;
}
