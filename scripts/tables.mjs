// Tables of reference.html that document the elements, from their declarations and their manifest. Each replaces a comment in the page.

/**
 * @typedef {import('./declarations.mjs').Widget} Widget
 * @typedef {import('./manifest.mjs').Element} Element
 * @typedef {import('./manifest.mjs').Item} Item
 */

/** Functions that make a table, by the name in its comment. @type {Record<string, (elements: Element[], widgets: Widget[]) => string>} */
const TABLE_BUILDERS = {
  attributes: (_, widgets) =>
    widgets
      .map(({ tag, attributes }) => {
        const rows = attributes.map((attribute) => [codeHtml(attribute.name), valuesHtml(attribute), proseHtml(attribute.withoutRange)]);
        return tableHtml(tag, 'attribute', codeHtml(`<${tag}>`), ['attribute', 'values', 'description'], rows);
      })
      .join('\n\n'),
  events: (elements) => itemTable(elements, 'event', 'Events; all bubble except <code>error</code>', ['event', 'fired when'], ({ events }) => events),
  methods: (elements) =>
    itemTable(elements, 'method', 'Methods', ['method', 'description'], ({ members }) =>
      members
        .filter(({ kind }) => kind === 'method')
        .map(({ name, parameters = [], description }) => ({ name: `${name}(${parameters.map((parameter) => parameter.name).join(', ')})`, description })),
    ),
  slots: (elements) => itemTable(elements, 'slot', 'Slots', ['slot', 'content'], ({ slots }) => slots),
  properties: (elements) => itemTable(elements, 'property', 'Custom properties', ['property', 'description'], ({ cssProperties }) => cssProperties),
  parts: (elements) => itemTable(elements, 'part', 'Parts, for <code>::part()</code>', ['part', 'description'], ({ cssParts }) => cssParts),
};

/**
 * @param {string} page HTML with comments like `<!-- table of events -->`
 * @param {Element[]} elements
 * @param {Widget[]} widgets
 * @returns {string} the page with the tables
 */
export function withTables(page, elements, widgets) {
  return page.replaceAll(/^ *<!-- table of (\w+) -->$/gm, (_, name) => TABLE_BUILDERS[name](elements, widgets));
}

/**
 * Returns a table of the items of all elements. An item that only some elements have names these elements.
 *
 * @param {Element[]} elements
 * @param {string} kind
 * @param {string} caption
 * @param {string[]} headings
 * @param {(element: Element) => Item[]} itemsOf
 */
function itemTable(elements, kind, caption, headings, itemsOf) {
  const itemsByName = new Map(elements.flatMap(itemsOf).map((item) => [item.name, item]));
  const elementsWith = (/** @type {string} */ name) => elements.filter((element) => itemsOf(element).some((item) => item.name === name));
  const rows = [...itemsByName.values()].map(({ name, description }) => {
    const owners = elementsWith(name);
    const ownersText = owners.length < elements.length ? ` Only ${owners.map(({ tagName }) => codeHtml(`<${tagName}>`)).join(' and ')}.` : '';
    return [codeHtml(name), proseHtml(description) + ownersText];
  });
  return tableHtml('both', kind, caption, headings, rows);
}

/**
 * @param {string} owner tag of the element that has the items, or "both" for all elements
 * @param {string} kind
 * @param {string} caption
 * @param {string[]} headings
 * @param {string[][]} rows of HTML
 */
function tableHtml(owner, kind, caption, headings, rows) {
  const headCells = headings.map((text) => `<th scope="col">${text}</th>`).join('');
  const bodyRows = rows.map(([name, ...cells]) => `            <tr><th scope="row">${name}</th>${cells.map((cell) => `<td>${cell}</td>`).join('')}</tr>`);
  return `        <table class="api" data-of="${owner}" data-kind="${kind}">
          <caption>${caption}</caption>
          <thead><tr>${headCells}</tr></thead>
          <tbody>
${bodyRows.join('\n')}
          </tbody>
        </table>`;
}

/** @param {import('./declarations.mjs').Attribute} attribute */
function valuesHtml({ type, allowed }) {
  const allowedWords = [...type.matchAll(/'([^']+)'/g)].map(([, word]) => codeHtml(word));
  return allowedWords.length ? allowedWords.join(', ') : (allowed ?? type);
}

/** Returns text as HTML, with code between backticks marked up. @param {string} [text] */
function proseHtml(text = '') {
  return escapedHtml(text).replaceAll(/`([^`]+)`/g, '<code>$1</code>');
}

/** Returns text as an HTML code element. @param {string} text */
function codeHtml(text) {
  return `<code>${escapedHtml(text)}</code>`;
}

/** Escapes text for HTML and its attributes. */
export const escapedHtml = (text = '') => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;').replaceAll('"', '&quot;');
