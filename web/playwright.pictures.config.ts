import tests from './playwright.config';

// Makes the pictures of web/pictures anew: `npm run pictures`.
export default { ...tests, testMatch: '**/*.pictures.ts' };
