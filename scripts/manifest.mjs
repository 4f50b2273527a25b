// Custom elements manifest (dist/custom-elements.json), which editors and documentation tools read.
//
// Attributes and properties come from the declarations. Methods, events, parts and colours come from the comments of the classes.
// A test in a browser compares the manifest with the elements.

import { readClassComments, joinLines, describeWidgets } from './declarations.mjs';

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
 * @property {Item[]} slots
 * @property {Item[]} cssParts
 * @property {Item[]} cssProperties
 */

/**
 * Returns the custom elements manifest.
 * @returns {Promise<{ schemaVersion: string, modules: { kind: string, path: string, declarations: Element[], exports: object[] }[] }>}
 */
export async function createManifest() {
  const { schemaVersion, classes } = await readClassComments();
  const elementDeclarations = (await describeWidgets()).map(({ tag, className, attributes, properties }) => {
    const elementName = `${className}Element`;
    const analyzedClass = classes.get(elementName);
    /** Replaces the general type names of the common class by those of the element's class. @param {string} typeText */
    const specializeType = (typeText) => ({ text: typeText.replace(/\bSimulation\b/, className).replace(/\bStateValues\b/, `${className}State`) });
    const itemOf = (/** @type {any} */ { name, type, description }) => ({ name, ...(type && { type: specializeType(type.text) }), description: description && joinLines(description) });
    const documentedItemsOf = (/** @type {any[]} */ memberItems) => memberItems.filter(({ description }) => description).map(itemOf);
    const memberOf = (/** @type {any} */ { kind, parameters, return: returnType, readonly, ...rest }) => ({
      kind,
      ...itemOf(rest),
      ...(parameters && { parameters: parameters.map(itemOf) }),
      ...(kind === 'method' && returnType && { return: { type: specializeType(returnType.type.text) } }),
      ...(readonly && { readonly }),
    });
    return {
      kind: 'class',
      name: elementName,
      tagName: tag,
      customElement: true,
      description: analyzedClass.description,
      attributes: attributes.map(({ name, property = name, type, description, opening }) => ({
        name,
        type: { text: type.replace(' | null', '') },
        description,
        fieldName: property,
        ...(opening !== undefined && { default: `${opening}` }),
      })),
      members: [
        ...attributes.map(({ name, property = name, type, description }) => ({ kind: 'field', name: property, type: { text: type }, description, attribute: name, reflects: true })),
        ...properties.map(({ name, type, description, readonly }) => ({ kind: 'field', name, type: { text: type }, description, ...(readonly && { readonly }) })),
        ...analyzedClass.members
          .filter((/** @type {any} */ { name, privacy }) => privacy === 'public' && !properties.some((property) => property.name === name))
          .map(memberOf),
      ],
      events: documentedItemsOf(analyzedClass.events),
      slots: documentedItemsOf(analyzedClass.slots),
      cssParts: documentedItemsOf(analyzedClass.cssParts),
      cssProperties: documentedItemsOf(analyzedClass.cssProperties),
    };
  });
  const modulePath = 'dist/external.js';
  const manifestExports = elementDeclarations.map(({ name, tagName }) => ({ kind: 'custom-element-definition', name: tagName, declaration: { name, module: modulePath } }));
  return { schemaVersion, modules: [{ kind: 'javascript-module', path: modulePath, declarations: elementDeclarations, exports: manifestExports }] };
}
