/** Records the errors of a page, because WebKit's driver has no access to the console. It runs before the other scripts of the page. */
{
  const recordedErrors = /** @type {string[]} */ ([]);
  Object.assign(globalThis, { recordedErrors });
  addEventListener('error', ({ message, target }) => recordedErrors.push(message ?? `${/** @type {any} */ (target).src ?? target} cannot be loaded`), true);
  addEventListener('unhandledrejection', ({ reason }) => recordedErrors.push(String(reason)));
  addEventListener('securitypolicyviolation', ({ violatedDirective }) => recordedErrors.push(violatedDirective));
  for (const name of /** @type {const} */ (['error', 'warn', 'assert'])) {
    const { [name]: original } = console;
    console[name] = (...args) => {
      if (name !== 'assert' || !args[0]) recordedErrors.push(args.map(String).join(' '));
      original.apply(console, args);
    };
  }
}
