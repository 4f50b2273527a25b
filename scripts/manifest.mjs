// dist/custom-elements.json: what editors and documentation tools know of the elements.
//
// Attributes and properties follow from what is declared; methods, events, parts and colours are what the classes'
// comments say, as the analyzer reads them. That it is true of the elements is tested in a browser.

import { widgets } from './declarations.mjs';
import { ROOT } from './process.mjs';

/**
 * @typedef {{ name: string, type?: { text: string }, description?: string }} Item
 * @typedef {Item & { default?: string, fieldName: string }} Attribute
 * @typedef {Item & { kind: 'field' | 'method', parameters?: Item[] }} Member
 *
 * @typedef {object} Element
 * @property {string} tagName
 * @property {Attribute[]} attributes
 * @property {Member[]} members
 * @property {Item[]} events
 * @property {Item[]} cssParts
 * @property {Item[]} cssProperties
 */

/** @returns {Promise<{ schemaVersion: string, modules: { kind: string, path: string, declarations: Element[], exports: object[] }[] }>} */
export async function manifest() {
  // @ts-expect-error It comes without types.
  const { cli } = await import('@custom-elements-manifest/analyzer/cli.js');
  const argv = ['analyze', '--litelement', '--quiet', '--globs', 'www/figure/figure.js', 'www/widgets/*/*.js'];
  const analyzed = await cli({ argv, cwd: ROOT, noWrite: true });
  /** @type {any[]} */
  const classes = analyzed.modules.flatMap((/** @type {any} */ { declarations }) => declarations ?? []);
  const declarations = (await widgets()).map((widget) => {
    const name = `${widget.machine}Element`;
    return elementOf(widget, name, classes.find((each) => each.name === name));
  });
  const path = 'dist/motion-widgets.js';
  const exports = declarations.map(({ name, tagName }) => ({ kind: 'custom-element-definition', name: tagName, declaration: { name, module: path } }));
  return { schemaVersion: analyzed.schemaVersion, modules: [{ kind: 'javascript-module', path, declarations, exports }] };
}

/**
 * @param {import('./declarations.mjs').Widget} widget
 * @param {string} name of its element's class
 * @param {any} comments what the class's say
 */
function elementOf({ tag, machine, attributes, properties }, name, comments) {
  /** In the comments of what all of them have, types are of no one machine. @param {string} type */
  const ours = (type) => ({ text: type.replace(/\bMachine\b/, machine).replace(/\bValues\b/, `${machine}State`) });
  const item = (/** @type {any} */ { name, type, description }) => ({ name, ...(type && { type: ours(type.text) }), description: description?.replaceAll('\n', ' ') });
  const documented = (/** @type {any[]} */ items) => items.filter(({ description }) => description).map(item);
  const member = (/** @type {any} */ { kind, parameters, return: result, readonly, ...rest }) => ({
    kind,
    ...item(rest),
    ...(parameters && { parameters: parameters.map(item) }),
    ...(kind === 'field' && result && { type: ours(result.type.text) }),
    ...(kind === 'method' && result && { return: { type: ours(result.type.text) } }),
    ...(readonly && { readonly }),
  });
  return {
    kind: 'class',
    name,
    tagName: tag,
    customElement: true,
    description: comments.description,
    attributes: attributes.map(({ name, type, description, opening }) => ({
      name,
      type: { text: type.replace(' | null', '') },
      description,
      fieldName: name,
      ...(opening !== undefined && { default: opening }),
    })),
    members: [
      ...attributes.map(({ name, type, description }) => ({ kind: 'field', name, type: { text: type }, description, attribute: name, reflects: true })),
      ...properties.map(({ name, type, description, readonly }) => ({ kind: 'field', name, type: { text: type }, description, ...(readonly && { readonly }) })),
      ...comments.members.filter((/** @type {any} */ { privacy }) => privacy === 'public').map(member),
    ],
    events: documented(comments.events),
    cssParts: documented(comments.cssParts),
    cssProperties: documented(comments.cssProperties),
  };
}
