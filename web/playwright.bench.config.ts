import tests from './playwright.config';

// Measures how quick the dashboard is: `npm run bench`.
export default { ...tests, testMatch: '**/*.bench.ts' };
