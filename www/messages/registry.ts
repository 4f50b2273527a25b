/**
 * Words of the elements, by language. English and German are included; a page adds or replaces others with `setMessages`. The words of a
 * single widget have their own key.
 *
 * An element uses the language of its nearest `lang` attribute if there are words in it, and otherwise English. Before an element is rendered or
 * drawn, `useLanguageOf` makes that the current language, which `words` and the numbers of ui/format.ts then have.
 */

export type MessageEntry = string | ((...messageValues: any[]) => string) | MessageEntry[] | { [messageKey: string]: MessageEntry };

export type MessageCatalogue = typeof import('./en.ts').en & import('../de.ts').WidgetWords;

/** Catalogues of words that all scripts of a page share, because each language may be in a separate script. */
interface SharedCatalogues {
  englishMessages: object;
  cataloguesByLanguage: Record<string, Record<string, object>>;
  /** Fires a `change` event when words or languages change. */
  changeEvents: EventTarget;
}

const REGISTRY_KEY = Symbol.for('motion-widgets.messages');

const sharedCatalogues: SharedCatalogues = ((globalThis as any)[REGISTRY_KEY] ??= { englishMessages: {}, cataloguesByLanguage: {}, changeEvents: new EventTarget() });

export let words: MessageCatalogue;

/** Current language as a BCP 47 tag, for the format of numbers. */
export let language = 'en';

const wordsByLanguage: Map<string, { words: MessageCatalogue, language: string }> = new Map();
sharedCatalogues.changeEvents.addEventListener('change', () => wordsByLanguage.clear());

/** Adds English words of the elements, which define the keys of all catalogues. */
export function addEnglishMessages(messageCatalogue: { [messageKey: string]: MessageEntry }) {
  sharedCatalogues.englishMessages = mergeMessages(sharedCatalogues.englishMessages, messageCatalogue);
  notifyListeners();
}

/**
 * Sets words of the elements in a language, immediately and on the whole page. Words that are left out stay as they were, and are English
 * in a new language.
 *
 * @param languageTag a BCP 47 tag: "de", "pt-BR"
 * @param messageCatalogue in the shape of the English ones, or a part of it. A list must have as many entries as the English one
 * @throws {RangeError} if there is no such language
 */
export function setMessages(languageTag: string, messageCatalogue: object) {
  const { cataloguesByLanguage } = sharedCatalogues;
  if (!isLanguageTag(languageTag)) throw new RangeError(`messages: lang is ${JSON.stringify(languageTag)}; allowed is a BCP 47 tag, as "de" or "pt-BR".`);
  const catalogueKey = languageTag.toLowerCase();
  cataloguesByLanguage[catalogueKey] = mergeMessages(cataloguesByLanguage[catalogueKey] ?? {}, messageCatalogue);
  notifyListeners();
}

function mergeMessages(baseMessages: any, overridingMessages: any) {
  const mergedMessages = { ...baseMessages };
  for (const [messageKey, overridingMessage] of Object.entries(overridingMessages)) {
    mergedMessages[messageKey] = typeof overridingMessage === 'object' && !Array.isArray(overridingMessage) ? mergeMessages(baseMessages[messageKey] ?? {}, overridingMessage) : overridingMessage;
  }
  return mergedMessages;
}

export function useLanguageOf(element: Element) {
  const wantedLanguage = languageOf(element);
  let cachedWords = wordsByLanguage.get(wantedLanguage);
  if (!cachedWords) {
    const [primaryTag] = wantedLanguage.split('-');
    const foundLanguage = [wantedLanguage, primaryTag].find((languageTag) => Object.hasOwn(sharedCatalogues.cataloguesByLanguage, languageTag)) ?? 'en';
    const language = primaryTag === foundLanguage && isLanguageTag(wantedLanguage) ? wantedLanguage : foundLanguage;
    const { englishMessages, cataloguesByLanguage } = sharedCatalogues;
    const mergedWords = [cataloguesByLanguage.en, cataloguesByLanguage[foundLanguage]].reduce((mergedMessages, overridingMessages) => mergeMessages(mergedMessages, overridingMessages ?? {}), englishMessages);
    wordsByLanguage.set(wantedLanguage, (cachedWords = { language, words: mergedWords as MessageCatalogue }));
  }
  ({ words, language } = cachedWords);
}

function isLanguageTag(tagText: unknown) {
  try {
    return typeof tagText === 'string' && Intl.getCanonicalLocales(tagText).length > 0;
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
export function onLanguage(element: Element, listener: () => void, abortSignal: AbortSignal) {
  languageObserver ??= new MutationObserver(notifyListeners);
  const observeOptions = { attributeFilter: ['lang'], subtree: true };
  languageObserver.observe(document, observeOptions);
  const rootNode = element.getRootNode();
  if (rootNode !== document) languageObserver.observe(rootNode, observeOptions);
  sharedCatalogues.changeEvents.addEventListener('change', listener, { signal: abortSignal });
}
