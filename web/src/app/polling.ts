import { useEffect } from 'preact/hooks';
import { loader } from './app';

/** Asks for an address again and again, for what no event tells; not without a time. */
export function useAskAgain(key: string | undefined, every_ms: number | undefined): void {
  useEffect(() => {
    if (key === undefined || every_ms === undefined) return;
    const timer = setInterval(() => loader.invalidate((each) => each === key), every_ms);
    return () => clearInterval(timer);
  }, [key, every_ms]);
}
