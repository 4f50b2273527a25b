/**
 * Words of the elements, by language. English and German are included; a page adds or replaces others with `setMessages`. The words of a
 * single widget have their own key.
 *
 * An element uses the language of its nearest `lang` attribute if there are words in it, and otherwise English. Before an element is rendered or
 * drawn, `useLanguageOf` makes that the current language. `words` and the numbers of ui/format.ts follow.
 */

export type Message = string | ((...values: any[]) => string) | Message[] | { [key: string]: Message };

export type Messages = typeof import('./en.ts').en & import('../de.ts').WidgetWords;

/** Catalogues of words that all scripts of a page share, because each language may be in a separate script. */
interface SharedCatalogues {
  english: object;
  catalogues: Record<string, Record<string, object>>;
  /** Fires a `change` event when words or languages change. */
  changeEvents: EventTarget;
}

const REGISTRY_KEY = Symbol.for('motion-widgets.messages');

const sharedCatalogues: SharedCatalogues = ((globalThis as any)[REGISTRY_KEY] ??= { english: {}, catalogues: {}, changeEvents: new EventTarget() });

export let words: Messages;

/** Current language as a BCP 47 tag, for the format of numbers. */
export let language = 'en';

const wordsByLanguage: Map<string, { words: Messages, language: string }> = new Map();
sharedCatalogues.changeEvents.addEventListener('change', () => wordsByLanguage.clear());

/** Adds English words of the elements, which define the keys of all catalogues. */
export function addEnglishMessages(messages: { [key: string]: Message }) {
  sharedCatalogues.english = mergeMessages(sharedCatalogues.english, messages);
  notifyListeners();
}

/**
 * Sets words of the elements in a language, immediately and on the whole page. Words that are left out stay as they were, and are English
 * in a new language.
 *
 * @param lang a BCP 47 tag: "de", "pt-BR"
 * @param messages in the shape of the English ones, or a part of it. A list must have as many entries as the English one
 * @throws {RangeError} if there is no such language
 */
export function setMessages(lang: string, messages: object) {
  const { catalogues } = sharedCatalogues;
  if (!isLanguageTag(lang)) throw new RangeError(`messages: lang is ${JSON.stringify(lang)}; allowed is a BCP 47 tag, as "de" or "pt-BR".`);
  const catalogueKey = lang.toLowerCase();
  catalogues[catalogueKey] = mergeMessages(catalogues[catalogueKey] ?? {}, messages);
  notifyListeners();
}

function mergeMessages(baseMessages: any, overrides: any) {
  const mergedMessages = { ...baseMessages };
  for (const [key, message] of Object.entries(overrides)) {
    mergedMessages[key] = typeof message === 'object' && !Array.isArray(message) ? mergeMessages(baseMessages[key] ?? {}, message) : message;
  }
  return mergedMessages;
}

export function useLanguageOf(element: Element) {
  const wantedLanguage = languageOf(element);
  let cachedWords = wordsByLanguage.get(wantedLanguage);
  if (!cachedWords) {
    const [primaryTag] = wantedLanguage.split('-');
    const foundLanguage = [wantedLanguage, primaryTag].find((tag) => Object.hasOwn(sharedCatalogues.catalogues, tag)) ?? 'en';
    const language = primaryTag === foundLanguage && isLanguageTag(wantedLanguage) ? wantedLanguage : foundLanguage;
    const { english, catalogues } = sharedCatalogues;
    const mergedWords = [catalogues.en, catalogues[foundLanguage]].reduce((base, overrides) => mergeMessages(base, overrides ?? {}), english);
    wordsByLanguage.set(wantedLanguage, (cachedWords = { language, words: mergedWords as Messages }));
  }
  ({ words, language } = cachedWords);
}

function isLanguageTag(text: unknown) {
  try {
    return typeof text === 'string' && Intl.getCanonicalLocales(text).length > 0;
  } catch {
    return false;
  }
}

/** Returns the nearest `lang` attribute of an element and its ancestors across shadow roots, in lower case, or an empty string. */
function languageOf(element: Element): string {
  for (let currentElement = element as Element | undefined; currentElement; ) {
    const elementWithLang = currentElement.closest('[lang]') as Element | null;
    if (elementWithLang) return elementWithLang.getAttribute('lang')?.toLowerCase() ?? '';
    const rootNode = currentElement.getRootNode();
    currentElement = rootNode instanceof ShadowRoot ? rootNode.host : undefined;
  }
  return '';
}

let languageObserver: MutationObserver | undefined;

/** This function is defined outside of `onLanguage`. A closure inside would keep the element of each call alive for as long as the page lives. */
function notifyListeners() {
  sharedCatalogues.changeEvents.dispatchEvent(new Event('change'));
}

/** Calls `listener` when the words or the language of an element may have changed, until the signal is aborted. */
export function onLanguage(element: Element, listener: () => void, signal: AbortSignal) {
  languageObserver ??= new MutationObserver(notifyListeners);
  const observeOptions = { attributeFilter: ['lang'], subtree: true };
  languageObserver.observe(document, observeOptions);
  const rootNode = element.getRootNode();
  if (rootNode !== document) languageObserver.observe(rootNode, observeOptions);
  sharedCatalogues.changeEvents.addEventListener('change', listener, { signal });
}
