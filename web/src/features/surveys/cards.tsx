// Figures of a survey as cards.

import { type ComponentChildren } from 'preact';
import { type Schema } from '../../lib/api';
import { cubicMetres, interval, referenceInWords } from './words';

export function Card({
  title,
  children,
  under,
}: {
  title: string;
  children: ComponentChildren;
  under?: ComponentChildren;
}) {
  return (
    <div class="survey-card">
      <dt>{title}</dt>
      <dd class="survey-card-value">{children}</dd>
      {under && <dd class="survey-under">{under}</dd>}
    </div>
  );
}

/** The first three of them. */
export function NetCutFill({
  total,
  reference,
}: {
  total: Schema<'SurveyDetail'>['total'];
  reference: Parameters<typeof referenceInWords>[0];
}) {
  return (
    <>
      <Card
        title={`Net against ${referenceInWords(reference)}`}
        under={interval(total.net.low_m3, total.net.high_m3, 'm³', true)}
      >
        {cubicMetres(total.net.value_m3, true)}
      </Card>
      <Card title="Cut" under={interval(total.cut.low_m3, total.cut.high_m3)}>
        {cubicMetres(total.cut.value_m3)}
      </Card>
      <Card title="Fill" under={interval(total.fill.low_m3, total.fill.high_m3)}>
        {cubicMetres(total.fill.value_m3)}
      </Card>
    </>
  );
}
