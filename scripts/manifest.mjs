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
  const { schemaVersion, classes: classesByName } = await readClassComments();
  const elementDeclarations = (await describeWidgets()).map(({ tag: widgetTag, className, attributes, properties: elementProperties }) => {
    const elementName = `${className}Element`;
    const analyzedClass = classesByName.get(elementName);
    /** Replaces the general type names of the common class by those of the element's class. @param {string} typeText */
    const specializeType = (typeText) => ({ text: typeText.replace(/\bSimulation\b/, className).replace(/\bStateValues\b/, `${className}State`) });
    const itemOf = (/** @type {any} */ { name: itemName, type, description }) => ({ name: itemName, ...(type && { type: specializeType(type.text) }), description: description && joinLines(description) });
    const documentedItemsOf = (/** @type {any[]} */ memberItems) => memberItems.filter(({ description }) => description).map(itemOf);
    const memberOf = (/** @type {any} */ { kind: memberKind, parameters: methodParameters, return: returnType, readonly, ...otherFields }) => ({
      kind: memberKind,
      ...itemOf(otherFields),
      ...(methodParameters && { parameters: methodParameters.map(itemOf) }),
      ...(memberKind === 'method' && returnType && { return: { type: specializeType(returnType.type.text) } }),
      ...(readonly && { readonly }),
    });
    return {
      kind: 'class',
      name: elementName,
      tagName: widgetTag,
      customElement: true,
      description: analyzedClass.description,
      attributes: attributes.map(({ name: attributeName, property: propertyName = attributeName, type, description, opening: openingText }) => ({
        name: attributeName,
        type: { text: type.replace(' | null', '') },
        description,
        fieldName: propertyName,
        ...(openingText !== undefined && { default: `${openingText}` }),
      })),
      members: [
        ...attributes.map(({ name: attributeName, property: propertyName = attributeName, type, description }) => ({ kind: 'field', name: propertyName, type: { text: type }, description, attribute: attributeName, reflects: true })),
        ...elementProperties.map(({ name: propertyName, type, description, readonly }) => ({ kind: 'field', name: propertyName, type: { text: type }, description, ...(readonly && { readonly }) })),
        ...analyzedClass.members
          .filter((/** @type {any} */ { name: memberName, privacy: memberPrivacy }) => memberPrivacy === 'public' && !elementProperties.some((property) => property.name === memberName))
          .map(memberOf),
      ],
      events: documentedItemsOf(analyzedClass.events),
      slots: documentedItemsOf(analyzedClass.slots),
      cssParts: documentedItemsOf(analyzedClass.cssParts),
      cssProperties: documentedItemsOf(analyzedClass.cssProperties),
    };
  });
  const modulePath = 'dist/external.js';
  const manifestExports = elementDeclarations.map(({ name: className, tagName }) => ({ kind: 'custom-element-definition', name: tagName, declaration: { name: className, module: modulePath } }));
  return { schemaVersion, modules: [{ kind: 'javascript-module', path: modulePath, declarations: elementDeclarations, exports: manifestExports }] };
}
