import { useResource } from '../../app/app';
import { address } from '../../lib/api';
import { PanoramaFigure } from '../panorama/panorama';

/** Where in the sensor's sight the change is. Nothing when it is not stored any more: the figures say what it was. */
export function AlertPicture({ change }: { change: number }) {
  const found = useResource(address('/api/v1/changes/{id}', { path: { id: change } }));
  if (!found.data) return null;
  return (
    <section class="alert-part">
      <h3>Where the sensor saw it</h3>
      <PanoramaFigure scan={found.data.scan} changes={[found.data]} />
    </section>
  );
}
