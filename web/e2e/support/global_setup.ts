import { simulateYard } from './build';

export default (): void => simulateYard();
