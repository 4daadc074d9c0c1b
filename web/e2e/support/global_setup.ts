import { simulateYard } from './build';

export default simulateYard;
