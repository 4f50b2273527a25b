/** Records the errors of a page, because WebKit's driver has no access to the console. This script runs before the other scripts of the page. */
{
  const recordedErrors = /** @type {string[]} */ ([]);
  Object.assign(globalThis, { recordedErrors });
  addEventListener('error', ({ message, target }) => recordedErrors.push(message ?? `${/** @type {any} */ (target).src ?? target} cannot be loaded`), true);
  addEventListener('unhandledrejection', ({ reason }) => recordedErrors.push(String(reason)));
  addEventListener('securitypolicyviolation', ({ violatedDirective }) => recordedErrors.push(violatedDirective));
  for (const consoleMethod of /** @type {const} */ (['error', 'warn', 'assert'])) {
    const { [consoleMethod]: originalMethod } = console;
    console[consoleMethod] = (...messageArguments) => {
      if (consoleMethod !== 'assert' || !messageArguments[0]) recordedErrors.push(messageArguments.map(String).join(' '));
      originalMethod.apply(console, messageArguments);
    };
  }
}
