// Tests of elements under the strictest Content-Security-Policy that allows them, and under policies that forbid them.

import { fileURLToPath } from 'node:url';
import { expect, test as testWithWarnings } from '@playwright/test';
import { startServer } from '../../scripts/serve.mjs';
import { waitForFrames, test, openDisclosures, waitUntilReady } from './support.js';

const DIST_DIRECTORY = fileURLToPath(new URL('../../dist', import.meta.url));
const STRICT_POLICY = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'";

/** @type {Awaited<ReturnType<typeof startServer>> | undefined} */
let policyServer;

for (const { afterEach } of [test, testWithWarnings]) {
  afterEach(() => {
    policyServer?.close();
    policyServer = undefined;
  });
}

/**
 * Opens a page of dist/ that is served with a policy, and records violations of the policy.
 *
 * @param {import('@playwright/test').Page} page
 * @param {string} contentPolicy
 * @param {string} pagePath
 * @returns {Promise<() => Promise<string[]>>} function that returns the violations so far
 */
async function openUnderPolicy(page, contentPolicy, pagePath) {
  policyServer = await startServer(DIST_DIRECTORY, { port: 0, headers: { 'content-security-policy': contentPolicy } });
  await page.addInitScript(() => {
    const policyViolations = /** @type {string[]} */ ([]);
    Object.assign(globalThis, { violations: policyViolations });
    addEventListener('securitypolicyviolation', ({ effectiveDirective, blockedURI, sample }) => {
      policyViolations.push(`${effectiveDirective} ${blockedURI} ${sample}`);
    });
  });
  await page.goto(policyServer.address + pagePath);
  return () => page.evaluate(() => /** @type {any} */ (globalThis).violations);
}

/** Returns a policy that allows only the named Trusted Types policies. @param {string} policyNames */
const trustedTypesPolicyOf = (policyNames) => `${STRICT_POLICY}; require-trusted-types-for 'script'; trusted-types ${policyNames}`;

test('a figure complies with a strict policy, even if the page has loaded another copy of Lit with its own Trusted Types policy', async ({ page, figureName }) => {
  // The policy "lit-html" is created before the figures load, as another copy of Lit on the page would do.
  await page.addInitScript(() => void Reflect.get(window, 'trustedTypes').createPolicy('lit-html', { createHTML: (/** @type {string} */ htmlText) => htmlText }));
  const readViolations = await openUnderPolicy(page, trustedTypesPolicyOf('lit-html motion-widgets'), `embed.html?widget=${figureName}`);
  const widget = page.locator(figureName);
  await waitUntilReady(widget);
  await openDisclosures(widget);
  await widget.getByRole('slider').first().press('ArrowRight');
  await waitForFrames(page);
  expect(await readViolations()).toEqual([]);
});

// The browser reports violations of a page's policy in the console. These tests must not fail on such messages.
testWithWarnings('a figure runs if the page allows only the Trusted Types policy with Lit’s name @nightly', async ({ page }) => {
  await openUnderPolicy(page, trustedTypesPolicyOf('lit-html'), 'embed.html?widget=banana-machine');
  await expect(page.locator('banana-machine canvas').first()).toBeVisible();
});

testWithWarnings('if no Trusted Types policy is allowed, the figure names the policy that it needs @nightly', async ({ page }) => {
  const consoleWarning = page.waitForEvent('console', (consoleMessage) => consoleMessage.type() === 'warning' && consoleMessage.text().includes('lacks'));
  await openUnderPolicy(page, trustedTypesPolicyOf("'none'"), 'embed.html?widget=banana-machine');
  const policyExplanation = "This page's Content-Security-Policy forbids the figure's templates: its trusted-types directive lacks motion-widgets.";
  await expect(page.locator('banana-machine')).toHaveText(`This interactive figure cannot run here. ${policyExplanation}`);
  expect((await consoleWarning).text()).toContain(policyExplanation);
});

testWithWarnings('if the policy forbids WebAssembly, the figure names the directive that it needs', async ({ page }) => {
  await openUnderPolicy(page, "script-src 'self'", 'embed.html?widget=banana-machine');
  await expect(page.locator('banana-machine').getByRole('alert')).toContainText("lacks 'wasm-unsafe-eval'");
});

testWithWarnings('in a browser without WebAssembly, the figure states in the page’s colours that it cannot run', async ({ page }) => {
  const pageErrors = /** @type {Error[]} */ ([]);
  page.on('pageerror', (pageError) => pageErrors.push(pageError));
  await page.addInitScript(() => void Reflect.deleteProperty(globalThis, 'WebAssembly'));
  const pageHtml = '<style>body { background: #123; color: #eee }</style><script type="module" src="./motion-widgets.js"></script><banana-machine></banana-machine>';
  await page.route('**/dark.html', (route) => route.fulfill({ contentType: 'text/html', body: pageHtml }));
  await openUnderPolicy(page, "script-src 'self'", 'dark.html');
  const widget = page.locator('banana-machine');
  await expect(widget.getByRole('alert')).toContainText('This interactive figure cannot run here.');
  expect(pageErrors).toEqual([]);
  const schemesAndBackgrounds = await widget.evaluate(async (element) => {
    // A figure that is not visible yet has the same colours as a visible one.
    const farFigure = /** @type {HTMLElement} */ (element.cloneNode());
    farFigure.style.marginTop = '5000px';
    document.body.append(farFigure);
    await Reflect.get(farFigure, 'updateComplete');
    return [element, farFigure].map(({ shadowRoot }) => {
      const surfaceStyle = /** @type {HTMLElement | undefined} */ (shadowRoot?.querySelector('.surface'))?.style;
      return [surfaceStyle?.colorScheme, surfaceStyle?.getPropertyValue('--background')];
    });
  });
  expect(schemesAndBackgrounds).toEqual(Array(2).fill(['dark', 'rgb(17,34,51)']));
});

testWithWarnings('if the policy forbids fetching the module, the embedded module is used, and a warning names the directive @nightly', async ({ page }) => {
  const pageHtml = '<script type="module" src="./external.js"></script><banana-machine></banana-machine>';
  await page.route('**/external.html', (route) =>
    route.fulfill({ contentType: 'text/html', headers: { 'content-security-policy': STRICT_POLICY }, body: pageHtml }),
  );
  const consoleWarning = page.waitForEvent('console', (consoleMessage) => consoleMessage.type() === 'warning');
  await openUnderPolicy(page, STRICT_POLICY, 'external.html');
  await expect(page.locator('banana-machine canvas').first()).toBeVisible();
  expect((await consoleWarning).text()).toMatch(/\.wasm cannot be fetched .*connect-src/);
});

testWithWarnings('if WebAssembly may be compiled but not run, as in WebKit, the figure names the directive that it needs @nightly', async ({ page }) => {
  await page.addInitScript(() => {
    const throwCompileError = () => {
      throw new WebAssembly.CompileError("Refused to create a WebAssembly object because 'unsafe-eval' or 'wasm-unsafe-eval' is not allowed");
    };
    Object.assign(WebAssembly, { instantiate: async () => throwCompileError(), Instance: throwCompileError });
  });
  await openUnderPolicy(page, STRICT_POLICY, 'embed.html?widget=banana-machine');
  const errorAlert = page.locator('banana-machine').getByRole('alert');
  await expect(errorAlert).toContainText("lacks 'wasm-unsafe-eval'");
  await expect(errorAlert).not.toContainText('Refused');
});
