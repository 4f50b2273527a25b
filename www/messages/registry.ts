/**
 * Words of the elements, by language. English and German are included; a page adds or replaces others with `setMessages`. The words of a
 * single widget have their own key.
 *
 * An element speaks the language of its nearest `lang` attribute as far as there are words in it, and
 * English otherwise. `speak` makes that language the present one before anything is rendered or
 * drawn, all of which happens at once: `words` and the numbers of ui/format.ts are in it then.
 */

export type Message = string | ((...values: any[]) => string) | Message[] | { [key: string]: Message };

/** `WidgetWords`: see widgets/words.d.ts. */
export type Messages = typeof import('./en.ts').en & WidgetWords;

/** Catalogues that all scripts of a page share, because a language may be in its own file. */
interface Shared {
  /** Default words of the elements. */
  english: object;
  /** Catalogues of the page, by language. */
  catalogues: Record<string, Record<string, object>>;
  /** Functions that run when words or languages change. */
  listeners: Set<() => void>;
}

const KEY = Symbol.for('motion-widgets.messages');

const shared: Shared = ((globalThis as any)[KEY] ??= { english: {}, catalogues: {}, listeners: new Set() });

/** Words of the current language. */
export let words: Messages;

/** Current language as a BCP 47 tag, for numbers. */
export let language = 'en';

/** Cache of words by the language of the page. */
const voices: Map<string, { words: Messages, language: string }> = new Map();
shared.listeners.add(() => voices.clear());

/** Adds the English words of the elements, which define the keys of all catalogues. An empty catalogue can be added first, and be filled by a later call. */
export function addEnglish(messages: { [key: string]: Message }) {
  shared.english = merge(shared.english, messages);
  // Checks messages of the page that were added before these keys were known.
  for (const [lang, given] of Object.entries(shared.catalogues)) {
    for (const key of Object.keys(messages).filter((key) => Object.hasOwn(given, key))) {
      try {
        check(messages, { [key]: given[key] }, lang);
      } catch (error) {
        delete given[key];
        reportError(error);
      }
    }
  }
  tellAll();
}

/**
 * Gives the elements words in a language, at once and on the whole page. What is left out stays as it
 * was, and is English in a new language.
 *
 * @param lang a BCP 47 tag: "de", "pt-BR"
 * @param messages in the shape of the English ones, or a part of it
 * @throws {RangeError} if there is no such language
 * @throws {TypeError} if a message is not of the catalogue, or not of the kind it is there: a list has as many entries as the
 *   English one, and a function is of as many values or fewer
 */
export function setMessages(lang: string, messages: object) {
  const { english, catalogues } = shared;
  if (!isTag(lang)) throw new RangeError(`messages: lang is ${JSON.stringify(lang)}; allowed is a BCP 47 tag, as "de" or "pt-BR".`);
  check(english, messages, lang);
  const key = lang.toLowerCase();
  catalogues[key] = merge(catalogues[key] ?? {}, messages);
  tellAll();
}

/** Throws a TypeError for messages that are not in the English catalogue. An empty catalogue has not come yet: then anything is accepted. */
function check(known: any, given: any, path: string) {
  if (Object.keys(known).length === 0) return;
  for (const [key, message] of Object.entries(given)) {
    const expected = Object.hasOwn(known, key) ? known[key] : undefined;
    const [is, allowed] = [describe(message), describe(expected)];
    const isLess = typeof message === 'function' && typeof expected === 'function' && message.length < expected.length;
    if (is !== allowed && !isLess) {
      const instead = expected === undefined ? `one of ${Object.keys(known).join(', ')}` : allowed;
      throw new TypeError(`messages: ${path}.${key} is ${is}; allowed is ${instead}.`);
    }
    if (typeof message === 'object') check(expected, message, `${path}.${key}`);
  }
}

function describe(value: any) {
  if (Array.isArray(value)) return `a list of ${value.length}`;
  if (typeof value === 'function') return `a function of ${value.length} values`;
  return value === null || value === undefined ? String(value) : typeof value === 'object' ? 'a group' : `a ${typeof value}`;
}

function merge(base: any, over: any) {
  const merged = { ...base };
  for (const [key, message] of Object.entries(over)) {
    merged[key] = typeof message === 'object' && !Array.isArray(message) ? merge(base[key] ?? {}, message) : message;
  }
  return merged;
}

/** Makes the language of an element the current one. */
export function speak(element: Element) {
  const wanted = languageOf(element);
  let voice = voices.get(wanted);
  if (!voice) {
    const [primary] = wanted.split('-');
    const found = [wanted, primary].find((tag) => Object.hasOwn(shared.catalogues, tag)) ?? 'en';
    const language = primary === found && isTag(wanted) ? wanted : found;
    const { english, catalogues } = shared;
    const said = [catalogues.en, catalogues[found]].reduce((base, over) => merge(base, over ?? {}), english);
    voices.set(wanted, (voice = { language, words: said as Messages }));
  }
  ({ words, language } = voice);
}

function isTag(text: unknown) {
  try {
    return typeof text === 'string' && Intl.getCanonicalLocales(text).length > 0;
  } catch {
    return false;
  }
}

/** Returns the nearest `lang` attribute of an element and its ancestors across shadow roots, in lower case, or an empty string. */
function languageOf(element: Element): string {
  for (let at = element as Element | undefined; at; ) {
    const bearer = at.closest('[lang]') as Element | null;
    if (bearer) return bearer.getAttribute('lang')?.toLowerCase() ?? '';
    const root = at.getRootNode();
    at = root instanceof ShadowRoot ? root.host : undefined;
  }
  return '';
}

let observer: MutationObserver | undefined;

/** Defined outside of `onLanguage`: a closure would keep the element of that call alive for as long as the page lives. */
function tellAll() {
  for (const listener of shared.listeners) listener();
}

/** Calls `listener` when the words or the language of an element may have changed, until the signal is aborted. */
export function onLanguage(element: Element, listener: () => void, signal: AbortSignal) {
  const { listeners } = shared;
  observer ??= new MutationObserver(tellAll);
  const watch = { attributeFilter: ['lang'], subtree: true };
  observer.observe(document, watch);
  const root = element.getRootNode();
  if (root !== document) observer.observe(root, watch);
  listeners.add(listener);
  signal.addEventListener('abort', () => listeners.delete(listener));
}
