/**
 * Substitute for the elements in a server component of React: that runs on the server alone, and what it imports for its effects never
 * comes to a browser.
 */
throw new Error(
  "motion-widgets is imported by a server component, and no browser would get it: import the elements from 'motion-widgets/react', " +
    "or import 'motion-widgets' in a file that begins with 'use client'.",
);
