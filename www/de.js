/**
 * German words for the elements: load it beside motion-widgets.js, before or after it.
 *
 * @module
 */
import { de } from './messages/de.js';
import { setMessages } from './messages/registry.js';

setMessages('de', de);
