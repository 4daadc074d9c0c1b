// What changed between any two epochs or time windows, asked for by hand.

import './schedules.css';
import './surveys.css';
import { navigate, useResource, useSelect } from '../../app/app';
import { useChosenSite, useZone } from '../../app/sites';
import { send } from '../../lib/api';
import { NewAtSite } from '../../ui/at_site';
import { EditForm, type PartProps, partWithin, useEditing } from '../../ui/edit_form';
import { FormPart, SelectField, TextField } from '../../ui/form';
import { Loaded } from '../../ui/states';
import { bodyOf, byHandLike, type ByHandDraft, faultsOf, newByHand, type Side } from './by_hand_draft';
import { surveyAt, surveysAreOld } from './data';
import { EpochField, epochsOf, ModelFields, ZonesPart } from './definition_fields';

export const CompareNightsView = () => (
  <NewAtSite title="Compare two nights" site={useChosenSite('survey')}>
    {(site) => <Begin site={site} />}
  </NewAtSite>
);

/** What is filled in at first depends on which epochs there are. */
function Begin({ site }: { site: string }) {
  const like = Number(useSelect((state) => state.location.query['like'])) || undefined;
  const survey = useResource(like === undefined ? undefined : surveyAt(like));
  const epochs = useResource(epochsOf(site));
  return like === undefined ? (
    <Loaded of={epochs} what="epochs">
      {({ items }) => <ByHandForm site={site} initial={newByHand(items)} />}
    </Loaded>
  ) : (
    <Loaded of={survey} what="survey">
      {(data) => <ByHandForm site={site} initial={byHandLike(data)} />}
    </Loaded>
  );
}

function ByHandForm({ site, initial }: { site: string; initial: ByHandDraft }) {
  const zone = useZone(site);
  const { draft, run, form } = useEditing(initial);
  const compare = (): void =>
    void run(async () => {
      const answer = await send('post', '/api/v1/surveys', { body: bodyOf(draft, site, zone) });
      surveysAreOld();
      navigate(`/surveys/runs/${answer.data.id}`);
    });
  return (
    <div class="schedule-editor">
      <EditForm {...form} words="Compare" faults={faultsOf(draft)} onSave={compare}>
        {(part) => (
          <>
            <p class="muted">An epoch is the scans of all stations within a time. No alert comes of it.</p>
            <OneSide {...part} side="before" title="Before" site={site} zone={zone} />
            <OneSide {...part} side="after" title="After" site={site} zone={zone} />
            <ZonesPart {...part} site={site} />
            <FormPart title="How exact">
              <ModelFields {...part} />
            </FormPart>
          </>
        )}
      </EditForm>
    </div>
  );
}

const kBy = [
  { value: 'epoch', words: 'an epoch that is there' },
  { value: 'window', words: 'the scans of a time' },
] as const;

function OneSide({
  side,
  title,
  site,
  zone,
  ...form
}: PartProps<ByHandDraft> & { side: Side; title: string; site: string; zone: string }) {
  const { draft, error, field } = partWithin(form, side);
  const { error: ofAll, ...epoch } = field('epoch', side);
  return (
    <FormPart title={title}>
      <div class="field-row field-row-wide">
        <SelectField label="By" options={kBy} {...field('by', `${side}.by`)} />
        {draft.by === 'epoch' ? (
          <EpochField label="Epoch" site={site} {...epoch} error={ofAll} />
        ) : (
          (['from', 'to'] as const).map((end) => (
            <TextField
              key={end}
              type="datetime-local"
              label={`${end === 'from' ? 'From' : 'To'} (${zone})`}
              {...field(end)}
              error={error(`${side}.${end}`) ?? (end === 'to' ? ofAll : undefined)}
            />
          ))
        )}
      </div>
    </FormPart>
  );
}
