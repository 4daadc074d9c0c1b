// What every test has: a daemon of its own, and a page in which nothing may go wrong unnoticed.

import { test as base, expect, type Page } from '@playwright/test';
import { createRequire } from 'node:module';
import { kYardScans, simulatePit } from './build';
import { Daemon } from './daemon';

/** What went wrong in a page: messages of errors, exceptions, and requests that failed. */
export class Troubles {
  private readonly found: string[] = [];
  private readonly expected: RegExp[] = [];

  watch(page: Page): void {
    page.on('console', (message) => {
      if (['error', 'warning'].includes(message.type())) this.found.push(`console: ${message.text()}`);
    });
    page.on('pageerror', (error) => this.found.push(`exception: ${error.message}`));
    page.on('response', (response) => {
      if (response.status() >= 400) this.found.push(`HTTP ${response.status()}: ${response.url()}`);
    });
    page.on('requestfailed', (request) => {
      const reason = request.failure()?.errorText ?? '';
      // The page itself ends what it no longer needs, such as the stream of events when it is left.
      if (reason !== 'net::ERR_ABORTED') this.found.push(`${reason}: ${request.url()}`);
    });
  }

  /** A test that makes trouble says which. */
  expect(pattern: RegExp): void {
    this.expected.push(pattern);
  }

  unexpected(): string[] {
    return this.found.filter((trouble) => !this.expected.some((pattern) => pattern.test(trouble)));
  }
}

interface Fixtures {
  /** An empty store. */
  daemon: Daemon;
  /** A store with the whole story of the yard. */
  yard: Daemon;
  /** A store with surveyed nights of a pit. */
  pit: Daemon;
  troubles: Troubles;
}

interface WorkerFixtures {
  yardStore: string;
  pitStore: string;
}

/** The page leaves before its daemon does: what it would say of that is no trouble. */
async function useDaemon(daemon: Daemon, page: Page, use: (daemon: Daemon) => Promise<void>): Promise<void> {
  await use(daemon);
  await page.goto('about:blank');
  await daemon.end();
}

export const test = base.extend<Fixtures, WorkerFixtures>({
  yardStore: [
    async ({}, use) => {
      const daemon = await Daemon.start();
      await daemon.makeYard();
      await daemon.upload(0, kYardScans);
      await daemon.stop();
      await use(daemon.store);
      await daemon.end();
    },
    { scope: 'worker', timeout: 120_000 },
  ],
  pitStore: [
    async ({}, use) => {
      simulatePit();
      const daemon = await Daemon.start();
      await daemon.makePit();
      await daemon.stop();
      await use(daemon.store);
      await daemon.end();
    },
    { scope: 'worker', timeout: 120_000 },
  ],
  daemon: async ({ page }, use) => {
    await useDaemon(await Daemon.start(), page, use);
  },
  yard: async ({ page, yardStore }, use) => {
    await useDaemon(await Daemon.start(yardStore), page, use);
  },
  pit: async ({ page, pitStore }, use) => {
    await useDaemon(await Daemon.start(pitStore), page, use);
  },
  troubles: [
    async ({ page }, use) => {
      const troubles = new Troubles();
      troubles.watch(page);
      await use(troubles);
      expect(troubles.unexpected(), 'nothing goes wrong in the page').toEqual([]);
    },
    { auto: true },
  ],
});

const axeSource = (createRequire(import.meta.url)('axe-core') as { source: string }).source;

interface AxeResults {
  violations: { id: string; impact: string | null; help: string; nodes: { html: string; failureSummary: string }[] }[];
}

/** What axe-core finds in the page that is serious or critical. */
export async function seriousViolations(page: Page): Promise<string[]> {
  await page.evaluate(axeSource);
  const results = (await page.evaluate('axe.run(document)')) as AxeResults;
  return results.violations
    .filter(({ impact }) => impact === 'serious' || impact === 'critical')
    .flatMap(({ id, help, nodes }) => nodes.map((node) => `${id}: ${help}: ${node.html} ${node.failureSummary}`));
}

/** Nothing reaches beyond the screen to the right. */
export async function expectNoSidewaysScrolling(page: Page): Promise<void> {
  const beyond = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
  expect(beyond).toBe(0);
}

/** The page knows who acts, so that it need not ask. */
export async function signIn(page: Page, name: string): Promise<void> {
  await page.addInitScript((operator) => {
    if (location.protocol !== 'about:') localStorage.setItem('raywatch.operator', operator);
  }, name);
}

export { expect };
