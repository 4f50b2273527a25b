// Generates React components for the elements, and their tags in JSX, from the declarations: build/react.js and build/react.d.ts. Common
// code is in www/react.ts. Common types are in this script.

import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { unionTypeOf, describeWidgets } from './declarations.mjs';
import { REPOSITORY_ROOT } from './process.mjs';

/** @typedef {import('./declarations.mjs').Widget} Widget */

const GENERATED_HEADER = '// Generated from the declarations: not to be edited.\n';

/** Writes build/react.js and build/react.d.ts. */
export async function writeComponents() {
  const widgetDescriptions = await describeWidgets();
  writeFileSync(join(REPOSITORY_ROOT, 'build/react.js'), `'use client';\n${GENERATED_HEADER}\nimport { createComponent } from '../www/react.ts';\n\n${widgetDescriptions.map(componentSourceOf).join('')}`);
  writeFileSync(join(REPOSITORY_ROOT, 'build/react.d.ts'), [GENERATED_HEADER, importLinesOf(widgetDescriptions), PROP_TYPES_SOURCE, ...widgetDescriptions.map(componentTypesOf), jsxTagsOf(widgetDescriptions)].join('\n'));
}

/** Returns the source of a component. @param {Widget} widget */
function componentSourceOf({ tag: widgetTag, className, attributes, properties: elementProperties }) {
  const propNames = {
    attributes: Object.fromEntries(attributes.map(({ name: attributeName, property: propertyName = attributeName }) => [propertyName, attributeName])),
    // Boolean attributes without a default are true if they are present. Other boolean attributes are written as true or false.
    flags: attributes.filter(({ type, opening: openingText }) => type === 'boolean' && openingText === undefined).map(({ name: attributeName }) => attributeName),
    properties: elementProperties.filter(({ readonly }) => !readonly).map(({ name: propertyName }) => propertyName),
  };
  return `export const ${className} = createComponent('${className}', '${widgetTag}', ${JSON.stringify(propNames)});\n`;
}

/** Returns the imports of the types. @param {Widget[]} allWidgets */
function importLinesOf(allWidgets) {
  const elementTypeNames = allWidgets.map(({ className }) => `${className}Element`);
  return (
    "import type { ClassAttributes, ForwardRefExoticComponent, HTMLAttributes, RefAttributes } from 'react';\n" +
    `import type { ${[...elementTypeNames, 'FigureElement', 'FigureEvents'].sort().join(', ')} } from '../www/types.d.ts';\n`
  );
}

const PROP_TYPES_SOURCE = `/** Type of a prop: numbers and lists of words also as text, as in attributes, and digits also as numbers. */
type PropValue<Value> = Value extends number
  ? Value | \`\${number}\`
  : Value extends \`\${infer Digit extends number}\`
  ? Value | Digit
  : Value extends string[]
    ? readonly Value[number][] | string
    : Value extends (infer Item)[]
      ? readonly Item[]
      : Value;

type Settings<Element, Names extends keyof Element> = { [Name in keyof Pick<Element, Names>]?: PropValue<Element[Name]> };

type Events<Element extends FigureElement<any, any>> = FigureEvents<NonNullable<Element['stats']>>;

/** Handler of an event of the element. */
type Handler<Element, EventType> = (event: EventType & { readonly currentTarget: Element }) => void;

type Handlers<Element extends FigureElement<any, any>> = {
  [Name in keyof Events<Element> as \`on\${Capitalize<Name>}\`]?: Handler<Element, Events<Element>[Name]>;
};

type OwnProps<Element extends FigureElement<any, any>, Names extends keyof Element> = Settings<Element, Names> & Handlers<Element>;

/** Props of a component: those of the element, and those of every HTML element. */
type Props<Element extends FigureElement<any, any>, Names extends keyof Element> = OwnProps<Element, Names> &
  Omit<HTMLAttributes<Element>, keyof OwnProps<Element, Names>>;

/** Type of an attribute in a JSX tag, with values that HTML can express. React may set the attribute and not the property. */
type AttributeValue<Value> = Value extends boolean
  ? true | \`\${Value}\`
  : Value extends number
    ? Value | \`\${number}\`
    : Value extends \`\${infer Digit extends number}\`
    ? Value | Digit
    : Value extends string[]
      ? string
      : Exclude<Value, null>;

type Tag<Element extends FigureElement<any, any>, Names extends keyof Element> = {
  [Name in keyof Pick<Element, Exclude<Names, 'headingLevel'>>]?: AttributeValue<Element[Name]>;
} & { 'heading-level'?: AttributeValue<Element['headingLevel']>; class?: string } & {
  [Name in keyof Events<Element> as \`on\${Name}\`]?: Handler<Element, Events<Element>[Name]>;
} & ClassAttributes<Element> &
  Omit<HTMLAttributes<Element>, Names | keyof Handlers<Element>>;
`;

/** Returns the types of a component. @param {Widget} widget */
function componentTypesOf({ tag: widgetTag, className, attributes, properties: elementProperties }) {
  const attributeUnion = unionTypeOf(attributes.map(({ name: attributeName, property: propertyName = attributeName }) => propertyName));
  const propertyUnion = unionTypeOf(elementProperties.filter(({ readonly }) => !readonly).map(({ name: propertyName }) => propertyName));
  return (
    `type ${className}Attributes = ${attributeUnion};\n\n` +
    `/** Props of \`<${className}>\`. */\n` +
    `export type ${className}Props = Props<${className}Element, ${className}Attributes | ${propertyUnion}>;\n\n` +
    `/** \`<${widgetTag}>\` as a component. */\n` +
    `export declare const ${className}: ForwardRefExoticComponent<${className}Props & RefAttributes<${className}Element>>;\n`
  );
}

/** Returns the types of the tags in JSX. @param {Widget[]} allWidgets */
function jsxTagsOf(allWidgets) {
  const tagLines = allWidgets.map(({ tag: widgetTag, className }) => `      '${widgetTag}': Tag<${className}Element, ${className}Attributes>;\n`);
  return `declare module 'react' {\n  namespace JSX {\n    interface IntrinsicElements {\n${tagLines.join('')}    }\n  }\n}\n`;
}
