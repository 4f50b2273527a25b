// Descriptions of the widgets for the scripts that generate types, tables and the manifest. They come from the settings of the core, from
// each widget's settings.ts, and from the comments of the elements' classes.

import { pathToFileURL } from 'node:url';
import { isDeepStrictEqual } from 'node:util';
import { register } from 'tsx/esm/api';
import { presets, settings } from '../build/settings.js';
import { REPOSITORY_ROOT, absolutePathOf, memoizeWork } from './process.mjs';

// tsx lets Node import TypeScript modules.
register();

/**
 * @typedef {import('../build/settings.js').Declaration} Declaration
 *
 * @typedef {object} Field
 * @property {string} name
 * @property {string} type type in TypeScript
 * @property {string} description
 * @property {true} [readonly]
 * @property {boolean} [isText] true if a number can be given as text
 *
 * @typedef {Field & { property?: string, opening?: string, allowed?: string, withoutRange: string, isCommon: boolean }} Attribute
 *   `property` is the name of its property if it differs, `opening` the text of its default, `allowed` the range of a number,
 *   `withoutRange` the description without that range, and `isCommon` true if every figure has the attribute
 *
 * @typedef {Record<string, { type: string, readonly?: true, sentence: string }>} DocumentationTable documentation by name
 *
 * @typedef {object} Documentation documentation that is neither in a declaration nor in the comments of a class
 * @property {DocumentationTable} [properties] properties that have no attribute
 * @property {DocumentationTable} [state] fields of the state that are neither settings nor attributes
 *
 * @typedef {object} Widget
 * @property {string} tag
 * @property {string} className name of its class in the core; the class of its element has the suffix Element
 * @property {Attribute[]} attributes attributes, each of which is also a property
 * @property {Field[]} properties properties without an attribute
 * @property {Field[]} state fields of the state that only this widget has
 */

/**
 * TypeScript types by type of setting. The types of words (enumerations) and of groups (several numbers) are generated.
 * @type {Record<string, string>}
 */
const TYPE_NAMES = { number: 'number', whole: 'number', boolean: 'boolean', numbers: 'number[]' };

/** Documentation of the property of elements with a sample that the user can select. @type {Documentation} */
const SELECTION_DOCUMENTATION = { properties: { marked: { type: 'number | null', sentence: 'The sample that is marked, counted from 0.' } } };

/** Documentation of the properties and state fields that every element with a cloud has. @type {Documentation} */
const CLOUD_DOCUMENTATION = {
  properties: {
    poses: { type: 'Float64Array | null', readonly: true, sentence: 'x, y (m), θ (rad) of each sample shown; a copy.' },
  },
  state: {
    shown: { type: 'number', sentence: 'Samples asked for so far, 0 to all of them.' },
    playing: { type: 'boolean', sentence: 'Whether the cloud is growing.' },
  },
};

/** Returns the name of the class or type for a tag or key. Throws if the name is invalid or taken in JavaScript. @param {string} tagOrKey */
export function toPascalCase(tagOrKey) {
  const pascalCaseName = tagOrKey.replaceAll(/(?:^|-)(.)/g, (_, firstLetter) => firstLetter.toUpperCase());
  if (!/^[A-Z]\w*$/.test(pascalCaseName)) throw new Error(`${pascalCaseName} cannot name a declaration in JavaScript: rename it.`);
  // A type with the name of a global type, such as Map or Event, would hide the global type in every script.
  if (pascalCaseName in globalThis) throw new Error(`${pascalCaseName} is a global of JavaScript: give the setting or element another name.`);
  return pascalCaseName;
}

/** Returns the TypeScript union type of some keywords. @param {readonly string[]} allowedWords */
export const unionTypeOf = (allowedWords) => allowedWords.map((allowedWord) => `'${allowedWord}'`).join(' | ');

/** Returns the TypeScript type of a setting. @param {Declaration} declaration */
function typeTextOf({ key: settingKey, type: fieldType, words, nullable }) {
  const typeText = words ? unionTypeOf(words) : (TYPE_NAMES[fieldType] ?? toPascalCase(settingKey));
  return nullable ? `${typeText} | null` : typeText;
}

/**
 * Returns the description of a setting, with its meaning, its allowed values and its default.
 *
 * @param {Declaration} settingDeclaration
 * @param {string} [openingValue] default as text
 */
function descriptionOf(settingDeclaration, openingValue) {
  const { sentence: docSentence, type: fieldType } = settingDeclaration;
  const rangeText = rangeTextOf(settingDeclaration);
  const numberKind = { whole: 'a whole number', numbers: 'each' }[/** @type {string} */ (fieldType)] ?? '';
  const allowedText = rangeText && `${numberKind} from ${rangeText}`.trim();
  const rangeAndOpeningText = [allowedText, openingValue && `opens with ${openingValue}`].filter(Boolean).join('; ');
  return rangeAndOpeningText ? `${docSentence} ${rangeAndOpeningText[0].toUpperCase()}${rangeAndOpeningText.slice(1)}.` : docSentence;
}

/** Returns the range of a setting as text. @param {Declaration} declaration */
function rangeTextOf({ min: minValue, max: maxValue, unit: unitText }) {
  return minValue === undefined || maxValue === undefined ? undefined : `${numberTextOf(minValue)} to ${numberTextOf(maxValue)}${unitText ? ` ${unitText}` : ''}`;
}

/** Returns the limit or default of a setting as text. @param {number} limitValue */
function numberTextOf(limitValue) {
  if (limitValue === Number.MAX_SAFE_INTEGER) return '2⁵³ − 1';
  const numberFormat = new Intl.NumberFormat('en', { maximumSignificantDigits: 7, useGrouping: 'min2' });
  return numberFormat.format(limitValue).replaceAll(',', '\u202f').replace('-', '−');
}

/** Imports a TypeScript module of www/. @param {string} repositoryPath relative to the root of the repository @returns {Promise<any>} */
export const importTypeScript = (repositoryPath) => import(pathToFileURL(absolutePathOf(repositoryPath)).href);

/** Returns the comments of the elements' classes by the names of the classes. */
export const readClassComments = memoizeWork(async () => {
  // @ts-expect-error The analyzer has no types.
  const { cli } = await import('@custom-elements-manifest/analyzer/cli.js');
  // With `noWrite` the analyzer returns the manifest and does not write it. It still writes the manifest's path, which `--outdir` sets, into package.json.
  const analyzerArguments = ['analyze', '--litelement', '--quiet', '--outdir', 'dist', '--globs', 'www/figure/figure.ts', 'www/widgets/*/*.ts'];
  const { schemaVersion, modules } = await cli({ argv: analyzerArguments, cwd: REPOSITORY_ROOT, noWrite: true });
  /** @type {any[]} */
  const classDeclarations = modules.flatMap((/** @type {any} */ { declarations }) => declarations ?? []);
  return { schemaVersion, classes: new Map(classDeclarations.map((classDeclaration) => [classDeclaration.name, classDeclaration])) };
});

/** Returns a description without the line breaks of its comment. @param {string} commentText */
export const joinLines = (commentText) => commentText.replaceAll('\n', ' ');

/** Returns the descriptions of all widgets. @returns {Promise<Widget[]>} */
export function describeWidgets() {
  return Promise.all(Object.keys(settings).map(describeWidget));
}

/** Returns the description of a widget. @param {string} widgetTag @returns {Promise<Widget>} */
async function describeWidget(widgetTag) {
  const { COMMON_PROPERTIES } = await importTypeScript('www/figure/definition.ts');
  const { definition: { attributes, settingDeclarations, elementFields }, documentation } = await importTypeScript(`www/widgets/${widgetTag}/settings.ts`);
  /** @type {Documentation[]} */
  const memberDocumentations = [...('marked' in elementFields ? [SELECTION_DOCUMENTATION] : []), ...('shown' in elementFields ? [CLOUD_DOCUMENTATION] : []), ...(documentation ? [documentation] : [])];
  const { classes: classesByName } = await readClassComments();
  const elementClass = classesByName.get(`${toPascalCase(widgetTag)}Element`);
  /** @type {Record<string, string>} */
  const attributeSentences = Object.fromEntries(elementClass.attributes.map((/** @type {any} */ { name: attributeName, description }) => [attributeName, description]));
  const documentedProperties = Object.assign({}, ...memberDocumentations.map(({ properties: elementProperties }) => elementProperties));
  const documentedState = Object.assign({}, ...memberDocumentations.map(({ state: stateDocumentation }) => stateDocumentation));
  const settingOf = (/** @type {string} */ fieldName) => settingDeclarations.find((/** @type {Declaration} */ { key: settingKey }) => settingKey === fieldName);

  /** Returns the description of an attribute. @returns {Omit<Attribute, 'isCommon'>} */
  const describeAttribute = (/** @type {[string, any]} */ [propertyName, propertyDefinition]) => {
    const settingDeclaration = settingOf(propertyName);
    if (settingDeclaration) {
      const defaultValue = settingDeclaration.default;
      const openingText = defaultValue === null ? undefined : String(defaultValue);
      const formattedDefault = typeof defaultValue === 'number' ? numberTextOf(defaultValue) : openingText;
      const withoutRange = descriptionOf({ ...settingDeclaration, min: undefined }, formattedDefault);
      return { name: propertyName, type: typeTextOf(settingDeclaration), description: descriptionOf(settingDeclaration, formattedDefault), opening: openingText, allowed: rangeTextOf(settingDeclaration), withoutRange };
    }
    const { words, attribute, default: commonDefault } = propertyDefinition;
    const fieldName = typeof attribute === 'string' ? attribute : propertyName;
    const elementField = elementFields[propertyName];
    const isPreset = propertyName === 'preset';
    const nullable = isPreset || commonDefault === null;
    const openingText = elementField?.default ?? (isPreset ? openingPresetOf(widgetTag) : commonDefault || undefined);
    const fieldType = elementField?.type === 'number' ? 'number' : words === undefined ? 'boolean' : elementField?.type === 'words' ? `(${unionTypeOf(words)})[]` : unionTypeOf(words);
    const typeText = Array.isArray(openingText) ? openingText.join(' ') : openingText;
    const description = descriptionOf({ ...propertyDefinition, ...elementField, sentence: attributeSentences[fieldName] }, typeText);
    return { name: fieldName, property: propertyName, type: nullable ? `${fieldType} | null` : fieldType, description, opening: typeText, allowed: elementField && rangeTextOf(elementField), withoutRange: description };
  };
  const toNamedDescription = (/** @type {[string, any]} */ [fieldName, { sentence: docSentence, ...otherFields }]) => ({ name: fieldName, description: docSentence, ...otherFields });

  const describedAttributes = Object.entries({ ...attributes, ...COMMON_PROPERTIES }).map((propertyEntry) => ({ ...describeAttribute(propertyEntry), isCommon: propertyEntry[0] in COMMON_PROPERTIES }));
  /** @type {Declaration[]} */
  const topLevelSettings = settingDeclarations.filter((/** @type {Declaration} */ settingDeclaration) => !settingDeclaration.in && !settingDeclaration.of);
  const groupFields = topLevelSettings.filter(({ key: settingKey }) => !(settingKey in attributes)).map(fieldOf);
  const classFields = elementClass.members
    .filter((/** @type {any} */ { kind, privacy: memberPrivacy, inheritedFrom }) => kind === 'field' && memberPrivacy === 'public' && !inheritedFrom)
    .map((/** @type {any} */ { name: fieldName, description, readonly, type: fieldType }) => ({ name: fieldName, description: joinLines(description), readonly, type: fieldType.text }));
  const elementProperties = [...groupFields, ...Object.entries(documentedProperties).map(toNamedDescription), ...classFields];
  const documentedElementFields = Object.keys(elementFields).map((fieldName) => {
    const { type: fieldType, description } = /** @type {Field} */ ([...describedAttributes, ...elementProperties].find((describedField) => describedField.name === fieldName) ?? {});
    return { name: fieldName, type: fieldType, description };
  });
  const stateFields = new Map([...topLevelSettings.map(fieldOf), ...documentedElementFields, ...Object.entries(documentedState).map(toNamedDescription)].map((stateField) => [stateField.name, stateField]));
  for (const { name: fieldName, type: fieldType } of stateFields.values()) if (!fieldType) throw new Error(`${widgetTag}: nothing says what ${fieldName} is in its state.`);
  return { tag: widgetTag, className: toPascalCase(widgetTag), attributes: describedAttributes, properties: elementProperties, state: [...stateFields.values()] };
}

/** Returns the description of a setting, or of a number of a group, as a field. @param {Declaration} settingDeclaration */
export function fieldOf(settingDeclaration) {
  return { name: settingDeclaration.field ?? settingDeclaration.key, type: typeTextOf(settingDeclaration), description: descriptionOf(settingDeclaration) };
}

/** Returns the preset with which the widget opens, if there is one. @param {string} widgetTag */
function openingPresetOf(widgetTag) {
  const defaultOf = (/** @type {string} */ fieldName) => settings[widgetTag].find(({ key: settingKey }) => settingKey === fieldName)?.default;
  const presetsOfTag = presets[/** @type {keyof typeof presets} */ (widgetTag)];
  return presetsOfTag.find((widgetPreset) => Object.entries(widgetPreset.settings).every(([settingKey, settingValue]) => isDeepStrictEqual(settingValue, defaultOf(settingKey))))?.name;
}
