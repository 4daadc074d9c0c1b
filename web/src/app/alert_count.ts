import { address } from '../lib/api';

/** The open alerts, which the menu counts and the overview shows. */
export const kOpenAlerts = address('/api/v1/alerts', { query: { state: 'open', limit: 200 } });
