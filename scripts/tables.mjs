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
        const attributeRows = attributes.map((attribute) => [codeHtml(attribute.name), valuesHtml(attribute), proseHtml(attribute.withoutRange)]);
        return tableHtml(tag, 'attribute', codeHtml(`<${tag}>`), ['attribute', 'values', 'description'], attributeRows);
      })
      .join('\n\n'),
  events: (elements) => itemTableHtml(elements, 'event', 'Events; all bubble except <code>error</code>', ['event', 'fired when'], ({ events }) => events),
  methods: (elements) =>
    itemTableHtml(elements, 'method', 'Methods', ['method', 'description'], ({ members }) =>
      members
        .filter(({ kind }) => kind === 'method')
        .map(({ name, parameters = [], description }) => ({ name: `${name}(${parameters.map((parameter) => parameter.name).join(', ')})`, description })),
    ),
  slots: (elements) => itemTableHtml(elements, 'slot', 'Slots', ['slot', 'content'], ({ slots }) => slots),
  properties: (elements) => itemTableHtml(elements, 'property', 'Custom properties', ['property', 'description'], ({ cssProperties }) => cssProperties),
  parts: (elements) => itemTableHtml(elements, 'part', 'Parts, for <code>::part()</code>', ['part', 'description'], ({ cssParts }) => cssParts),
};

/**
 * Returns a page with tables in place of their comments.
 *
 * @param {string} page HTML with comments like `<!-- table of events -->`
 * @param {Element[]} elements
 * @param {Widget[]} widgets
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
 * @param {(element: Element) => Item[]} itemsOfElement
 */
function itemTableHtml(elements, kind, caption, headings, itemsOfElement) {
  const itemsByName = new Map(elements.flatMap(itemsOfElement).map((item) => [item.name, item]));
  const elementsWithItem = (/** @type {string} */ name) => elements.filter((element) => itemsOfElement(element).some((item) => item.name === name));
  const itemRows = [...itemsByName.values()].map(({ name, description }) => {
    const owningElements = elementsWithItem(name);
    const ownersText = owningElements.length < elements.length ? ` Only ${owningElements.map(({ tagName }) => codeHtml(`<${tagName}>`)).join(' and ')}.` : '';
    return [codeHtml(name), proseHtml(description) + ownersText];
  });
  return tableHtml('both', kind, caption, headings, itemRows);
}

/**
 * Returns a table of attributes or other items.
 *
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

/** Returns the allowed values of an attribute. @param {import('./declarations.mjs').Attribute} attribute */
function valuesHtml({ type, allowed }) {
  const allowedWords = [...type.matchAll(/'([^']+)'/g)].map(([, word]) => codeHtml(word));
  return allowedWords.length ? allowedWords.join(', ') : (allowed ?? type);
}

/** Returns text as HTML, with code between backticks marked up. @param {string} [text] */
function proseHtml(text = '') {
  return escapeHtml(text).replaceAll(/`([^`]+)`/g, '<code>$1</code>');
}

/** Returns text as an HTML code element. @param {string} text */
function codeHtml(text) {
  return `<code>${escapeHtml(text)}</code>`;
}

/** Escapes text for HTML and its attributes. */
export const escapeHtml = (text = '') => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;').replaceAll('"', '&quot;');
