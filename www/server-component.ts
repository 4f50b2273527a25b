/**
 * Substitute for the elements in a server component of React. Such a component runs on the server alone: an import for its side effects
 * does not reach the browser.
 */
throw new Error(
  "motion-widgets is imported by a server component, and no browser would get it: import the elements from 'motion-widgets/react', " +
    "or import 'motion-widgets' in a file that begins with 'use client'.",
);
