/** Components for React 18 and 19. build/react.js, which is generated from the declarations, has one for each element. */

import { createElement, forwardRef, useEffect, useImperativeHandle, useLayoutEffect, useRef, useState } from 'react';
import 'motion-widgets';

export type ReactProps = Record<string, any>;

/** Names of the props of an element. */
interface PropNames {
  /** Names of attributes by the names of their props. */
  attributes: Record<string, string>;
  /** Names of the props of boolean attributes, which are present or absent. */
  flags: string[];
  /** Names of the props of properties that have no attribute. */
  properties: string[];
}

/** Props of event handlers by event type. */
const HANDLER_PROPS = { load: 'onLoad', error: 'onError', input: 'onInput', change: 'onChange', stats: 'onStats' };
const EVENT_TYPES = Object.keys(HANDLER_PROPS) as (keyof typeof HANDLER_PROPS)[];

const isOnServer = typeof document === 'undefined';
/** Hook for layout effects. On a server there is no layout, and React 18 warns about `useLayoutEffect`. */
const useLayout = isOnServer ? useEffect : useLayoutEffect;

/**
 * Writer of the props of a React component to its element. It writes a prop only if its value has changed since the last rendering:
 * a list in JSX is another object each time, and would undo changes of the user. React itself only writes attributes on a server. On the
 * page its choice of attributes or properties would depend on its version, and on the time at which the element is defined.
 */
class PropWriter {
  element: any;
  propNames: PropNames;
  /** Props of the previous rendering. */
  props: ReactProps | undefined;

  constructor(propNames: PropNames) {
    this.propNames = propNames;
  }

  /** Returns the text of a prop's attribute, or null. */
  attributeTextOf(propName: string, { [propName]: propValue = null }: ReactProps) {
    if (propValue === null || (propValue === false && this.propNames.flags.includes(propName))) return null;
    return Array.isArray(propValue) ? propValue.join(' ') : propValue === true ? '' : String(propValue);
  }

  update(element: any, reactProps: ReactProps) {
    const { props: previousProps } = this;
    Object.assign(this, { element, props: reactProps });
    for (const eventType of EVENT_TYPES) element.addEventListener(eventType, this);
    if (!previousProps && element.stats) {
      // An element in the server's HTML may have started before React attached the listeners. Its first events are therefore fired again.
      element.dispatchEvent(new Event('load'));
      element.dispatchEvent(new CustomEvent('stats', { detail: element.stats }));
    }
    for (const [propName, attributeName] of Object.entries(this.propNames.attributes)) {
      const attributeText = this.attributeTextOf(propName, reactProps);
      // Attributes that the server has sent are kept at first, because the user may have changed the figure in the meantime.
      if (previousProps ? attributeText === this.attributeTextOf(propName, previousProps) : attributeText === null || element.hasAttribute(attributeName)) continue;
      if (attributeText === null) element.removeAttribute(attributeName);
      else element.setAttribute(attributeName, attributeText);
    }
    const isChanged = (propName: string) => previousProps?.[propName] !== reactProps[propName] && JSON.stringify(previousProps?.[propName]) !== JSON.stringify(reactProps[propName]);
    for (const propName of this.propNames.properties.filter(isChanged)) element[propName] = reactProps[propName];
  }

  handleEvent(event: Event) {
    this.props?.[HANDLER_PROPS[(event.type as keyof typeof HANDLER_PROPS)]]?.(event);
  }

  removeListeners() {
    for (const eventType of EVENT_TYPES) this.element.removeEventListener(eventType, this);
  }
}

export function createComponent(displayName: string, elementTag: string, propNames: PropNames) {
  const ownProps = new Set([...Object.keys(propNames.attributes), ...propNames.properties, ...Object.values(HANDLER_PROPS)]);
  const renderComponent = (reactProps: ReactProps, forwardedRef: import('react').ForwardedRef<unknown>) => {
    const elementRef = useRef(null);
    const [propWriter] = useState(() => new PropWriter(propNames));
    useImperativeHandle(forwardedRef, () => elementRef.current, []);
    useLayout(() => propWriter.update(elementRef.current, reactProps));
    useLayout(() => () => propWriter.removeListeners(), [propWriter]);
    // `className` is passed as `class`, because React 18 does not translate it for custom elements.
    const { className, ...otherProps } = Object.fromEntries(Object.entries(reactProps).filter(([propName]) => !ownProps.has(propName)));
    const attributeTexts = isOnServer ? Object.entries(propNames.attributes).map(([propName, attributeName]) => [attributeName, propWriter.attributeTextOf(propName, reactProps)]) : [];
    return createElement(elementTag, { ...otherProps, ...Object.fromEntries(attributeTexts), class: className, ref: elementRef, suppressHydrationWarning: true });
  };
  return Object.assign(forwardRef(renderComponent), { displayName });
}
