/** Records the errors of a page, because WebKit's driver has no access to the console. It runs before the other scripts of the page. */
{
  const complaints = /** @type {string[]} */ ([]);
  Object.assign(globalThis, { complaints });
  addEventListener('error', ({ message, target }) => complaints.push(message ?? `${/** @type {any} */ (target).src ?? target} cannot be loaded`), true);
  addEventListener('unhandledrejection', ({ reason }) => complaints.push(String(reason)));
  addEventListener('securitypolicyviolation', ({ violatedDirective }) => complaints.push(violatedDirective));
  for (const name of /** @type {const} */ (['error', 'warn', 'assert'])) {
    const { [name]: original } = console;
    console[name] = (...args) => {
      if (name !== 'assert' || !args[0]) complaints.push(args.map(String).join(' '));
      original.apply(console, args);
    };
  }
}
