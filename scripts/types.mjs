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
  // wasm-bindgen writes the comments of Rust macros as raw string literals (r"…). Their prefix is removed here.
  const coreTypes = readFileSync(join(REPOSITORY_ROOT, 'build/core.d.ts'), 'utf8').replaceAll('* r" ', '* ');
  writeFileSync(join(REPOSITORY_ROOT, 'build/simulations.d.ts'), [DISPOSABLE_LIBRARY, GENERATED_HEADER, OPTIONS_IMPORT, ...composeGroupInterfaces(), ...Object.keys(settings).map(settingsInterfaceOf), coreTypes].join('\n'));
  writeFileSync(join(REPOSITORY_ROOT, 'build/elements.d.ts'), [GENERATED_HEADER, importLineOf(widgetDescriptions), await composeFigureTypes(widgetDescriptions), ...widgetDescriptions.map(elementTypesOf), tagTypesOf(widgetDescriptions)].join('\n'));
  for (const [frameworkName, { module, namespace, any, prefix }] of Object.entries(TEMPLATE_FRAMEWORKS)) {
    writeFileSync(
      join(REPOSITORY_ROOT, `build/${frameworkName}.d.ts`),
      `${GENERATED_HEADER}
import type { FigureTags } from '../build/elements.d.ts';

type WithPrefixed<Fields> = Fields & { [Name in keyof Fields as \`${prefix}\${Name & string}\`]?: Fields[Name] };
type Tags = { [Tag in keyof FigureTags]: Omit<${any}<HTMLElementTagNameMap[Tag]>, keyof FigureTags[Tag]> & WithPrefixed<FigureTags[Tag]> };

declare module '${module}' {
  ${namespace}
}
`);
  }
}

/** Returns the text of the interfaces of groups of settings. A group must be the same in all widgets that have it. */
function composeGroupInterfaces() {
  /** @type {Map<string, string>} */
  const interfaceByGroup = new Map();
  for (const [widgetTag, declaredSettings] of Object.entries(settings)) {
    for (const { key, type } of declaredSettings) {
      if (type !== 'group') continue;
      const groupFields = declaredSettings.filter((groupPart) => groupPart.in === key).map(fieldOf);
      const interfaceText = interfaceOf(toPascalCase(key), groupFields);
      if ((interfaceByGroup.get(key) ?? interfaceText) !== interfaceText) throw new Error(`${widgetTag}: ${key} is not the group that it is in another widget; call it otherwise.`);
      interfaceByGroup.set(key, interfaceText);
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
  const { classes } = await readClassComments();
  /** @type {any[]} */
  const publicMembers = classes.get('FigureElement').members.filter((/** @type {any} */ { privacy }) => privacy === 'public');
  /** Returns a type, with type parameters in place of types that depend on the widget. @param {{ type: { text: string } }} [typedItem] */
  const specializedTypeOf = (typedItem) => (typedItem?.type.text ?? 'void').replace(/\bSimulation\['stats'\]/, 'Stats').replace(/\bStateValues\b/, 'State');
  const memberFields = publicMembers.map(({ kind, name, description, parameters = [], type, return: returnType, readonly }) => {
    const parameterTexts = parameters.map((/** @type {any} */ methodParameter) => `${methodParameter.name}: ${specializedTypeOf(methodParameter)}`);
    return { name: kind === 'method' ? `${name}(${parameterTexts.join(', ')})` : name, type: specializedTypeOf(kind === 'method' ? returnType : { type }), description: joinLines(description), readonly };
  });
  const commonFields = attributes.filter(({ isCommon }) => isCommon).map(({ property, ...rest }) => ({ ...rest, name: property ?? rest.name }));
  const eventFields = classes.get('FigureElement').events.map((/** @type {any} */ { name, type, description }) => {
    const typeText = type?.text ?? 'Event';
    return { name, type: typeText === 'CustomEvent' ? `CustomEvent<${name[0].toUpperCase()}${name.slice(1)}>` : typeText, description: joinLines(description) };
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
  return overloadLines.map((name) => ({ name, type: 'void', description: '' }));
});

/** Returns the text of the types of an element and of its state. @param {import('./declarations.mjs').Widget} widget */
function elementTypesOf({ tag, className, attributes, properties, state }) {
  const baseType = `FigureElement<${className}State, ${className}['stats']>`;
  const widgetField = { name: 'widget', type: `'${tag}'`, description: '' };
  // The members that every figure has are in FigureElement.
  const widgetFields = attributes.filter(({ isCommon }) => !isCommon).map((attributeDescription) => ({ ...attributeDescription, isText: true }));
  return (
    `${interfaceOf(`${className}State`, [widgetField, ...state], 'FigureState')}\n` +
    `/** \`<${tag}>\`. Its attributes have the properties' names. */\n` +
    interfaceOf(`${className}Element`, [...widgetFields, ...properties], baseType)
  );
}

/** Returns the text of the import of the types that the elements use. @param {import('./declarations.mjs').Widget[]} widgets */
function importLineOf(widgets) {
  const typeNames = widgets.flatMap(({ properties, state }) => [...properties, ...state]).flatMap(({ type }) => type.match(/\b[A-Z]\w*/g) ?? []);
  const neededTypeNames = new Set(['FigureState', ...widgets.map(({ className }) => className), ...typeNames]);
  const importedNames = [...neededTypeNames].filter((name) => !(name in globalThis));
  return `import type { ${importedNames.sort().join(', ')} } from '../www/types.d.ts';\n`;
}

/** Returns the text of the types of the elements by tag. @param {import('./declarations.mjs').Widget[]} widgets */
function tagTypesOf(widgets) {
  const tagMapLines = widgets.map(({ tag, className }) => `    '${tag}': ${className}Element;\n`);
  const tagLines = widgets.map(({ tag, className, attributes, properties }) => {
    const propertyNames = [...attributes.map(({ name, property = name }) => property), ...properties.filter(({ readonly }) => !readonly).map(({ name }) => name)];
    return `  '${tag}': TemplateValues<${className}Element, ${unionTypeOf(propertyNames)}>;\n`;
  });
  return `/** Values that a template gives to an element: numbers and lists also as text, as attributes have them. */
type TemplateValues<Element, Names extends keyof Element> = { [Name in Names]?: Element[Name] | string | null } & { 'heading-level'?: string };

/** Properties that a template (JSX, Vue, Svelte) can set on each element, by tag. */
export interface FigureTags {
${tagLines.join('')}}

declare global {
  interface HTMLElementTagNameMap {
${tagMapLines.join('')}  }
}
`;
}

/** Returns an interface as TypeScript text. @param {string} interfaceName @param {Field[]} interfaceFields @param {string} [baseInterface] */
function interfaceOf(interfaceName, interfaceFields, baseInterface) {
  const memberLines = interfaceFields.map(({ name: key, type, description, readonly, isText }) => {
    const commentText = description && `  /** ${description} */\n`;
    if (isText) return `${commentText}  get ${key}(): ${type};\n  set ${key}(value: ${type.replace(' | null', '')} | string | null | undefined);\n`;
    return `${commentText}  ${readonly ? 'readonly ' : ''}${key}: ${type};\n`;
  });
  return `export interface ${interfaceName}${baseInterface ? ` extends ${baseInterface}` : ''} {\n${memberLines.join('')}}\n`;
}
