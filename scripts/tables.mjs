// Tables of reference.html that document the elements, from their declarations and their manifest. Each replaces a comment in the page.

/**
 * @typedef {import('./declarations.mjs').Widget} Widget
 * @typedef {import('./manifest.mjs').Element} Element
 * @typedef {import('./manifest.mjs').Item} Item
 */

/** Functions that make a table, by the name in its comment. @type {Record<string, (elements: Element[], widgets: Widget[]) => string>} */
const TABLES = {
  attributes: (_, widgets) =>
    widgets
      .map(({ tag, attributes }) => {
        const rows = attributes.map((each) => [code(each.name), valuesOf(each), proseHtml(each.withoutRange)]);
        return table(tag, 'attribute', code(`<${tag}>`), ['attribute', 'values', 'description'], rows);
      })
      .join('\n\n'),
  events: (elements) => shared(elements, 'event', 'Events; all bubble except <code>error</code>', ['event', 'fired when'], ({ events }) => events),
  methods: (elements) =>
    shared(elements, 'method', 'Methods', ['method', 'description'], ({ members }) =>
      members
        .filter(({ kind }) => kind === 'method')
        .map(({ name, parameters = [], description }) => ({ name: `${name}(${parameters.map((each) => each.name).join(', ')})`, description })),
    ),
  slots: (elements) => shared(elements, 'slot', 'Slots', ['slot', 'content'], ({ slots }) => slots),
  properties: (elements) => shared(elements, 'property', 'Custom properties', ['property', 'description'], ({ cssProperties }) => cssProperties),
  parts: (elements) => shared(elements, 'part', 'Parts, for <code>::part()</code>', ['part', 'description'], ({ cssParts }) => cssParts),
};

/**
 * @param {string} page HTML with comments like `<!-- table of events -->`
 * @param {Element[]} elements
 * @param {Widget[]} widgets
 * @returns {string} it with the tables
 */
export function withTables(page, elements, widgets) {
  return page.replaceAll(/^ *<!-- table of (\w+) -->$/gm, (_, name) => TABLES[name](elements, widgets));
}

/**
 * Returns a table of the items of all elements, followed by those of some.
 *
 * @param {Element[]} elements
 * @param {string} kind
 * @param {string} caption
 * @param {string[]} heads
 * @param {(element: Element) => Item[]} items
 */
function shared(elements, kind, caption, heads, items) {
  const all = new Map(elements.flatMap(items).map((item) => [item.name, item]));
  const bearers = (/** @type {string} */ name) => elements.filter((element) => items(element).some((item) => item.name === name));
  const rows = [...all.values()].map(({ name, description }) => {
    const of = bearers(name);
    const only = of.length < elements.length ? ` Only ${of.map(({ tagName }) => code(`<${tagName}>`)).join(' and ')}.` : '';
    return [code(name), proseHtml(description) + only];
  });
  return table('both', kind, caption, heads, rows);
}

/**
 * @param {string} of
 * @param {string} kind
 * @param {string} caption
 * @param {string[]} heads
 * @param {string[][]} rows of HTML
 */
function table(of, kind, caption, heads, rows) {
  const head = heads.map((text) => `<th scope="col">${text}</th>`).join('');
  const body = rows.map(([name, ...cells]) => `            <tr><th scope="row">${name}</th>${cells.map((cell) => `<td>${cell}</td>`).join('')}</tr>`);
  return `        <table class="api" data-of="${of}" data-kind="${kind}">
          <caption>${caption}</caption>
          <thead><tr>${head}</tr></thead>
          <tbody>
${body.join('\n')}
          </tbody>
        </table>`;
}

/** @param {import('./declarations.mjs').Attribute} attribute */
function valuesOf({ type, allowed }) {
  const words = [...type.matchAll(/'([^']+)'/g)].map(([, word]) => code(word));
  return words.length ? words.join(', ') : (allowed ?? type);
}

/** Returns text as HTML, with code between backticks marked up. @param {string} [text] */
function proseHtml(text = '') {
  return escaped(text).replaceAll(/`([^`]+)`/g, '<code>$1</code>');
}

/** Returns text as an HTML code element. @param {string} text */
function code(text) {
  return `<code>${escaped(text)}</code>`;
}

/** Escapes text for HTML and its attributes. */
export const escaped = (text = '') => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;').replaceAll('"', '&quot;');
