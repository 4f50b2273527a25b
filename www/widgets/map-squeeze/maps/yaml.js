/**
 * Reading YAML. In a file of its own, so that it can be loaded when it is first needed, and without
 * the other half of the library, which writes.
 */

export { YAMLException, load } from 'js-yaml';
