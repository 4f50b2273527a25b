/**
 * Attributes and the properties of the same names: how a text becomes a value, and the other way round.
 *
 * @module
 */

/**
 * @typedef {object} Kind
 * @property {(text: string) => unknown} read a text that means nothing is returned as it is, for whoever
 *   knows what is allowed to refuse
 * @property {(value: any) => string | null} write null for no attribute
 */

/**
 * A setting of the machine.
 *
 * @typedef {object} Setting
 * @property {Kind} kind
 * @property {string} [property] where it is not called as the attribute
 * @property {(config: any, motion: any) => unknown} get null for none
 * @property {(value: any, config: any, motion: any) => object} change the settings to make of it
 * @property {string[]} [covers] attributes that say the same and take over where this one says nothing
 */

/**
 * Something of the element itself, which has a property of that name.
 *
 * @typedef {object} Own
 * @property {Kind} kind
 * @property {true} own
 * @property {string[]} [covers] attributes that say the same and take over where this one says nothing
 */

/** @typedef {Record<string, Setting | Own>} Attributes by name */

/** @type {Kind} */
export const NUMBER = {
  read: (text) => (text.trim() === '' || Number.isNaN(Number(text)) ? text : Number(text)),
  write: (value) => (value === null ? null : String(value)),
};

/** @type {Kind} */
export const WORD = { read: (text) => text, write: (value) => value };

/** Without a text it is true, as boolean attributes of HTML are; but "false" is false. @type {Kind} */
export const TRUTH = {
  read: (text) => ({ '': true, true: true, false: false })[text] ?? text,
  write: String,
};

/** Words with spaces between them. @type {Kind} */
export const WORDS = { read: (text) => text.split(/\s+/).filter(Boolean), write: (value) => value.join(' ') };

/**
 * @param {string} attribute
 * @param {Setting | Own} entry
 */
export function propertyOf(attribute, entry) {
  return 'property' in entry && entry.property ? entry.property : attribute;
}

/**
 * @param {Setting | Own} entry
 * @returns {entry is Setting}
 */
export function isSetting(entry) {
  return !('own' in entry);
}

/**
 * A setting that is a number or a word of the same name in the core's settings.
 *
 * @param {string} key
 * @param {Kind} kind
 * @returns {Setting}
 */
export function plain(key, kind) {
  return { kind, get: (config) => config[key], change: (value) => ({ [key]: value }) };
}

/**
 * A setting that is a field of one of the core's settings.
 *
 * @param {string} group
 * @param {string} key
 * @returns {Setting}
 */
export function field(group, key) {
  return {
    kind: NUMBER,
    get: (config) => config[group][key],
    change: (value, config) => ({ [group]: { ...config[group], [key]: value } }),
  };
}

/**
 * A preset's name for a group of settings; none where it is no preset's.
 *
 * @template {{ name: string }} Preset
 * @param {(motion: import('../types.d.ts').Motion) => Preset[]} presets
 * @param {(preset: Preset) => Record<string, Record<string, number>>} settings that it stands for
 * @param {string[]} covers
 * @returns {Setting}
 */
export function preset(presets, settings, covers) {
  const holds = (/** @type {Preset} */ one, /** @type {any} */ config) =>
    Object.entries(settings(one)).every(([group, fields]) =>
      Object.entries(fields).every(([key, value]) => config[group][key] === value),
    );
  return {
    kind: WORD,
    covers,
    get: (config, motion) => presets(motion).find((one) => holds(one, config))?.name ?? null,
    change: (name, config, motion) => {
      const all = presets(motion);
      const found = all.find((one) => one.name === name);
      if (found) return settings(found);
      const allowed = all.map((one) => JSON.stringify(one.name)).join(' or ');
      const Kind = typeof name === 'string' ? RangeError : TypeError;
      throw new Kind(`preset is ${JSON.stringify(name) ?? String(name)}; allowed is ${allowed}`);
    },
  };
}
