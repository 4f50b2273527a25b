/**
 * What a server component of React gets instead of the elements: it runs on the server alone, and what it imports for its
 * effects never comes to a browser.
 */
throw new Error(
  "motion-widgets is imported by a server component, and no browser would get it: import the elements from 'motion-widgets/react', " +
    "or import 'motion-widgets' in a file that begins with 'use client'.",
);
