// Tables that document the elements, made from their declarations and their manifest. Each table replaces a comment in a page.

import { readFileSync } from 'node:fs';
import { describeWidgets } from './declarations.mjs';
import { absolutePathOf } from './process.mjs';

/**
 * @typedef {import('./declarations.mjs').Widget} Widget
 * @typedef {import('./manifest.mjs').Element} Element
 * @typedef {import('./manifest.mjs').Item} Item
 */

/**
 * Functions that make a table, by the name in the comment that the table replaces.
 * @type {Record<string, (elements: Element[], widgets: Widget[]) => string>}
 */
const TABLE_BUILDERS = {
  attributes: (_, widgets) =>
    widgets
      .map(({ tag: widgetTag, attributes }) => {
        const attributeRows = attributes.map((attributeDescription) => [renderCode(attributeDescription.name), renderValues(attributeDescription), renderProse(attributeDescription.withoutRange)]);
        return renderTable(widgetTag, 'attribute', renderCode(`<${widgetTag}>`), ['attribute', 'values', 'description'], attributeRows);
      })
      .join('\n\n'),
  events: (elementDeclarations) => renderItemTable(elementDeclarations, 'event', 'Events; all bubble except <code>error</code>', ['event', 'fired when'], ({ events: elementEvents }) => elementEvents),
  methods: (elementDeclarations) =>
    renderItemTable(elementDeclarations, 'method', 'Methods', ['method', 'description'], ({ members: classMembers }) =>
      classMembers
        .filter(({ kind: itemKind }) => itemKind === 'method')
        .map(({ name: itemName, parameters: methodParameters = [], description }) => ({ name: `${itemName}(${methodParameters.map((methodParameter) => methodParameter.name).join(', ')})`, description })),
    ),
  slots: (elementDeclarations) => renderItemTable(elementDeclarations, 'slot', 'Slots', ['slot', 'content'], ({ slots: elementSlots }) => elementSlots),
  properties: (elementDeclarations) => renderItemTable(elementDeclarations, 'property', 'Custom properties', ['property', 'description'], ({ cssProperties }) => cssProperties),
  parts: (elementDeclarations) => renderItemTable(elementDeclarations, 'part', 'Parts, for <code>::part()</code>', ['part', 'description'], ({ cssParts }) => cssParts),
};

/** Returns a page with tables in place of comments like `<!-- table of events -->`. @param {string} pageHtml */
export async function insertTables(pageHtml) {
  const { modules } = JSON.parse(readFileSync(absolutePathOf('dist/custom-elements.json'), 'utf8'));
  const widgets = await describeWidgets();
  return pageHtml.replaceAll(/<!-- table of (\w+) -->/g, (_, itemName) => TABLE_BUILDERS[itemName](modules[0].declarations, widgets));
}

/**
 * Returns a table of the items of all elements. If only some elements have an item, the item names these elements.
 *
 * @param {Element[]} elementDeclarations
 * @param {string} itemKind
 * @param {string} tableCaption
 * @param {string[]} columnHeadings
 * @param {(element: Element) => Item[]} itemsOf
 */
function renderItemTable(elementDeclarations, itemKind, tableCaption, columnHeadings, itemsOf) {
  const itemsByName = new Map(elementDeclarations.flatMap(itemsOf).map((manifestItem) => [manifestItem.name, manifestItem]));
  const findElementsWithItem = (/** @type {string} */ itemName) => elementDeclarations.filter((documentedElement) => itemsOf(documentedElement).some((manifestItem) => manifestItem.name === itemName));
  const itemRows = [...itemsByName.values()].map(({ name: itemName, description }) => {
    const owningElements = findElementsWithItem(itemName);
    const ownersSentence = owningElements.length < elementDeclarations.length ? ` Only ${owningElements.map(({ tagName }) => renderCode(`<${tagName}>`)).join(' and ')}.` : '';
    return [renderCode(itemName), renderProse(description) + ownersSentence];
  });
  return renderTable('both', itemKind, tableCaption, columnHeadings, itemRows);
}

/**
 * Returns a table of attributes or other items.
 *
 * @param {string} tableOwner tag of the element that has the items, or "both" for all elements
 * @param {string} itemKind
 * @param {string} tableCaption
 * @param {string[]} columnHeadings
 * @param {string[][]} tableRows cells as HTML
 */
function renderTable(tableOwner, itemKind, tableCaption, columnHeadings, tableRows) {
  const headCells = columnHeadings.map((headingText) => `<th scope="col">${headingText}</th>`).join('');
  const bodyRows = tableRows.map(([itemName, ...rowCells]) => `            <tr><th scope="row">${itemName}</th>${rowCells.map((cellHtml) => `<td>${cellHtml}</td>`).join('')}</tr>`);
  return `        <table class="api" data-of="${tableOwner}" data-kind="${itemKind}">
          <caption>${tableCaption}</caption>
          <thead><tr>${headCells}</tr></thead>
          <tbody>
${bodyRows.join('\n')}
          </tbody>
        </table>`;
}

/** Returns the allowed values of an attribute. @param {import('./declarations.mjs').Attribute} attribute */
function renderValues({ type, allowed: allowedText }) {
  const allowedWords = [...type.matchAll(/'([^']+)'/g)].map(([, allowedWord]) => renderCode(allowedWord));
  return allowedWords.length ? allowedWords.join(', ') : (allowedText ?? type);
}

/** Returns text as HTML, with code between backticks marked up. @param {string} [proseText] */
function renderProse(proseText = '') {
  return escapeHtml(proseText).replaceAll(/`([^`]+)`/g, '<code>$1</code>');
}

/** Returns text as an HTML code element. @param {string} codeText */
function renderCode(codeText) {
  return `<code>${escapeHtml(codeText)}</code>`;
}

/** Escapes text for HTML and its attributes. */
export const escapeHtml = (text = '') => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;').replaceAll('"', '&quot;');
