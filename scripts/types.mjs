// Generates TypeScript types from the declarations: build/simulations.d.ts for the core, build/elements.d.ts for the elements, and the tags
// in templates of Solid and Svelte. www/types.d.ts exports the types of the core and the elements, and contains the types that are written
// by hand, such as those of options.

import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { settings } from '../build/settings.js';
import { readClassComments, fieldOf, joinLines, toPascalCase, unionTypeOf, describeWidgets } from './declarations.mjs';
import { REPOSITORY_ROOT } from './process.mjs';

/** @typedef {import('./declarations.mjs').Field} Field */

const GENERATED_HEADER = '// Generated from the declarations: not to be edited.\n';

/** Declaration of `Symbol.dispose`, which may be missing in the `lib` setting of a project. */
const DISPOSABLE_LIBRARY = '/// <reference lib="esnext.disposable" />\n';

/** Import of the types of the core's arguments. */
const OPTIONS_IMPORT = "import type { Calibration, CalibrationOptions, OdometryModelOptions, Propagation, Twist, VelocityModelOptions } from '../www/types.d.ts';\n";

/**
 * Frameworks with typed templates. Each has the module and the interface that the tags extend, the type of the attributes of any element,
 * and the prefix of properties.
 */
const TEMPLATE_FRAMEWORKS = {
  solid: { module: 'solid-js', namespace: 'namespace JSX { interface IntrinsicElements extends Tags {} }', any: "import('solid-js').JSX.HTMLAttributes", prefix: 'prop:' },
  svelte: { module: 'svelte/elements', namespace: 'interface SvelteHTMLElements extends Tags {}', any: "import('svelte/elements').HTMLAttributes", prefix: '' },
};

/** Writes all declaration files. */
export async function writeTypes() {
  const widgetDescriptions = await describeWidgets();
  // wasm-bindgen writes doc comments from Rust macros as raw string literals, r"…. This call removes the prefix r".
  const coreTypes = readFileSync(join(REPOSITORY_ROOT, 'build/core.d.ts'), 'utf8').replaceAll('* r" ', '* ');
  writeFileSync(join(REPOSITORY_ROOT, 'build/simulations.d.ts'), [DISPOSABLE_LIBRARY, GENERATED_HEADER, OPTIONS_IMPORT, ...composeGroupInterfaces(), ...Object.keys(settings).map(settingsInterfaceOf), coreTypes].join('\n'));
  writeFileSync(join(REPOSITORY_ROOT, 'build/elements.d.ts'), [GENERATED_HEADER, importLineOf(widgetDescriptions), await composeFigureTypes(widgetDescriptions), ...widgetDescriptions.map(elementTypesOf), tagTypesOf(widgetDescriptions)].join('\n'));
  for (const [frameworkName, { module: moduleName, namespace: namespaceText, any: anyAttributes, prefix: attributePrefix }] of Object.entries(TEMPLATE_FRAMEWORKS)) {
    writeFileSync(
      join(REPOSITORY_ROOT, `build/${frameworkName}.d.ts`),
      `${GENERATED_HEADER}
import type { FigureTags } from '../build/elements.d.ts';

type WithPrefixed<Fields> = Fields & { [Name in keyof Fields as \`${attributePrefix}\${Name & string}\`]?: Fields[Name] };
type Tags = { [Tag in keyof FigureTags]: Omit<${anyAttributes}<HTMLElementTagNameMap[Tag]>, keyof FigureTags[Tag]> & WithPrefixed<FigureTags[Tag]> };

declare module '${moduleName}' {
  ${namespaceText}
}
`);
  }
}

/** Returns the text of the interfaces of groups of settings. A group must be the same in all widgets that have it. */
function composeGroupInterfaces() {
  /** @type {Map<string, string>} */
  const interfaceByGroup = new Map();
  for (const [widgetTag, declaredSettings] of Object.entries(settings)) {
    for (const { key: settingKey, type: fieldType } of declaredSettings) {
      if (fieldType !== 'group') continue;
      const groupFields = declaredSettings.filter((groupPart) => groupPart.in === settingKey).map(fieldOf);
      const interfaceText = interfaceOf(toPascalCase(settingKey), groupFields);
      if ((interfaceByGroup.get(settingKey) ?? interfaceText) !== interfaceText) throw new Error(`${widgetTag}: ${settingKey} is not the group that it is in another widget; call it otherwise.`);
      interfaceByGroup.set(settingKey, interfaceText);
    }
  }
  return interfaceByGroup.values();
}

/** Returns the text of the interface of a widget's settings. @param {string} widgetTag */
function settingsInterfaceOf(widgetTag) {
  return interfaceOf(`${toPascalCase(widgetTag)}Settings`, settings[widgetTag].filter((settingDeclaration) => !settingDeclaration.in && !settingDeclaration.of).map(fieldOf));
}

/** Returns the text of the types that all figures share; any widget has their common attributes. @param {import('./declarations.mjs').Widget[]} widgets */
async function composeFigureTypes([{ attributes }]) {
  const { classes: classesByName } = await readClassComments();
  /** @type {any[]} */
  const publicMembers = classesByName.get('FigureElement').members.filter((/** @type {any} */ { privacy: memberPrivacy }) => memberPrivacy === 'public');
  /** Returns a type, with type parameters in place of types that depend on the widget. @param {{ type: { text: string } }} [typedItem] */
  const specializedTypeOf = (typedItem) => (typedItem?.type.text ?? 'void').replace(/\bSimulation\['stats'\]/, 'Stats').replace(/\bStateValues\b/, 'State');
  const memberFields = publicMembers.map(({ kind: memberKind, name: memberName, description, parameters: methodParameters = [], type: fieldType, return: returnType, readonly }) => {
    const parameterTexts = methodParameters.map((/** @type {any} */ methodParameter) => `${methodParameter.name}: ${specializedTypeOf(methodParameter)}`);
    return { name: memberKind === 'method' ? `${memberName}(${parameterTexts.join(', ')})` : memberName, type: specializedTypeOf(memberKind === 'method' ? returnType : { type: fieldType }), description: joinLines(description), readonly };
  });
  const commonFields = attributes.filter(({ isCommon }) => isCommon).map(({ property: propertyName, ...otherFields }) => ({ ...otherFields, name: propertyName ?? otherFields.name }));
  const eventFields = classesByName.get('FigureElement').events.map((/** @type {any} */ { name: eventName, type: fieldType, description }) => {
    const typeText = fieldType?.text ?? 'Event';
    return { name: eventName, type: typeText === 'CustomEvent' ? `CustomEvent<${eventName[0].toUpperCase()}${eventName.slice(1)}>` : typeText, description: joinLines(description) };
  });
  return (
    `/** Events of an element for \`addEventListener\`; \`Stats\` are those of its class. */\n${interfaceOf('FigureEvents<Stats>', eventFields)}\n` +
    '/** Members of every element. */\n' +
    interfaceOf('FigureElement<State extends FigureState, Stats>', [...commonFields, ...memberFields, ...LISTENER_METHODS], 'HTMLElement')
  );
}

/**
 * Methods that add and remove listeners. They have an overload for the events of a figure, and one for the events of every element.
 * @type {Field[]}
 */
const LISTENER_METHODS = ['add', 'remove'].flatMap((listenerVerb) => {
  const optionsParameter = `options?: boolean | ${listenerVerb === 'add' ? 'AddEventListenerOptions' : 'EventListenerOptions'}`;
  const listenerOverloadOf = (/** @type {string} */ eventsType) =>
    `${listenerVerb}EventListener<Type extends keyof ${eventsType}>(type: Type, listener: (this: FigureElement<State, Stats>, event: ${eventsType}[Type]) => unknown, ${optionsParameter})`;
  const overloadLines = [listenerOverloadOf('FigureEvents<Stats>'), listenerOverloadOf('HTMLElementEventMap'), `${listenerVerb}EventListener(type: string, listener: EventListenerOrEventListenerObject, ${optionsParameter})`];
  return overloadLines.map((overloadLine) => ({ name: overloadLine, type: 'void', description: '' }));
});

/** Returns the text of the types of an element and of its state. @param {import('./declarations.mjs').Widget} widget */
function elementTypesOf({ tag: widgetTag, className, attributes, properties: elementProperties, state: stateFields }) {
  const baseType = `FigureElement<${className}State, ${className}['stats']>`;
  const widgetField = { name: 'widget', type: `'${widgetTag}'`, description: '' };
  // The members that every figure has are in FigureElement.
  const widgetFields = attributes.filter(({ isCommon }) => !isCommon).map((attributeDescription) => ({ ...attributeDescription, isText: true }));
  return (
    `${interfaceOf(`${className}State`, [widgetField, ...stateFields], 'FigureState')}\n` +
    `/** \`<${widgetTag}>\`. Its attributes have the properties' names. */\n` +
    interfaceOf(`${className}Element`, [...widgetFields, ...elementProperties], baseType)
  );
}

/** Returns the text of the import of the types that the elements use. @param {import('./declarations.mjs').Widget[]} widgets */
function importLineOf(widgets) {
  const typeNames = widgets.flatMap(({ properties: elementProperties, state: stateFields }) => [...elementProperties, ...stateFields]).flatMap(({ type: fieldType }) => fieldType.match(/\b[A-Z]\w*/g) ?? []);
  const neededTypeNames = new Set(['FigureState', ...widgets.map(({ className }) => className), ...typeNames]);
  const importedNames = [...neededTypeNames].filter((typeName) => !(typeName in globalThis));
  return `import type { ${importedNames.sort().join(', ')} } from '../www/types.d.ts';\n`;
}

/** Returns the text of the types of the elements by tag. @param {import('./declarations.mjs').Widget[]} widgets */
function tagTypesOf(widgets) {
  const tagMapLines = widgets.map(({ tag: widgetTag, className }) => `    '${widgetTag}': ${className}Element;\n`);
  const tagTypeLines = widgets.map(({ tag: widgetTag, className, attributes, properties: elementProperties }) => {
    const propertyNames = [...attributes.map(({ name: attributeName, property: propertyName = attributeName }) => propertyName), ...elementProperties.filter(({ readonly }) => !readonly).map(({ name: propertyName }) => propertyName)];
    return `  '${widgetTag}': TemplateValues<${className}Element, ${unionTypeOf(propertyNames)}>;\n`;
  });
  return `/** Values that a template gives to an element: numbers and lists also as text, as attributes have them. */
type TemplateValues<Element, Names extends keyof Element> = { [Name in Names]?: Element[Name] | string | null } & { 'heading-level'?: string };

/** Properties that a template (JSX, Vue, Svelte) can set on each element, by tag. */
export interface FigureTags {
${tagTypeLines.join('')}}

declare global {
  interface HTMLElementTagNameMap {
${tagMapLines.join('')}  }
}
`;
}

/** Returns an interface as TypeScript text. @param {string} interfaceName @param {Field[]} interfaceFields @param {string} [baseInterface] */
function interfaceOf(interfaceName, interfaceFields, baseInterface) {
  const memberLines = interfaceFields.map(({ name: fieldName, type: fieldType, description, readonly, isText }) => {
    const commentText = description && `  /** ${description} */\n`;
    if (isText) return `${commentText}  get ${fieldName}(): ${fieldType};\n  set ${fieldName}(value: ${fieldType.replace(' | null', '')} | string | null | undefined);\n`;
    return `${commentText}  ${readonly ? 'readonly ' : ''}${fieldName}: ${fieldType};\n`;
  });
  return `export interface ${interfaceName}${baseInterface ? ` extends ${baseInterface}` : ''} {\n${memberLines.join('')}}\n`;
}
