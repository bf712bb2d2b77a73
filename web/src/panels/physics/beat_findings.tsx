import { useState } from 'preact/hooks';
import type { Traces } from '../../engine/contract';
import {
  dropBeat,
  heartFound,
  heartIsPlayed,
  heartPeriodMs,
  heartTraces,
  keepBeat,
  keptBeats,
  renameBeat,
} from '../../store/run/beat/heartbeat';
import { figuresOf, loopOf, ventricleNames, ventricles } from '../../store/run/beat/loops';
import { awaitsFrames, simulationEndMs, simulationOf } from '../../store/run/frames';
import { dark } from '../../store/view';
import { cssColour } from '../controls/chart_style';
import { RemoveButton } from '../controls/folded_item';
import { short } from '../controls/format';
import { Icon } from '../controls/icons';
import { writeFiles } from '../controls/write_files';
import { LoopChart, type LoopLine } from './loop_chart';
import { TraceChart } from './trace_chart';

/** Colours of lines over time, those of the theme as it is. */
const lineColours = ['--axis-r', '--axis-s', '--chart-before', '--chart-pinned', '--axis-a', '--text-soft'];
const keptColours = ['--chart-before', '--chart-pinned', '--axis-s', '--axis-r', '--axis-a'];
/** Of a run that is kept, by its number. */
const keptColour = (id: number): string => `var(${keptColours[(id - 1) % keptColours.length]})`;

function Loops({ traces }: { traces: Traces }) {
  const periodMs = heartPeriodMs.value;
  return (
    <figure class="loops">
      {ventricles.map((name) => {
        const loop = loopOf(traces, name);
        const kept = keptBeats.value.flatMap((one): LoopLine[] => {
          const other = loopOf(one.traces, name);
          const colour = keptColour(one.id);
          return other ? [{ name: one.name, colour, loop: other, periodMs: one.periodMs, kept: true }] : [];
        });
        if (!loop || loop.times_ms.length < 2) return null;
        const own = { name: 'This run', colour: 'var(--chart-now)', loop, periodMs, kept: false };
        return (
          <div key={name}>
            <figcaption>{ventricleNames[name]}</figcaption>
            <LoopChart title={ventricleNames[name]} lines={[...kept, own]} seeks={heartIsPlayed.value} />
          </div>
        );
      })}
    </figure>
  );
}

/** Volumes and pressures over time; of the circulation the pressures in vessels. */
function OverTime({ traces }: { traces: Traces }) {
  void dark.value;
  const first = Math.max(
    0,
    traces.times_ms.findIndex((time) => time > -1e-6),
  );
  const chart = (unit: string, name: string) => {
    const lines = traces.lines
      .filter((line) => line.unit === unit)
      .map(({ title, values }, i) => ({
        title: title.replace(/, (volume|pressure)$/, ''),
        colour: cssColour(lineColours[i % lineColours.length]),
        values: values.slice(first),
      }));
    return (
      <TraceChart
        name={`${name}, ${unit} over ms`}
        label={`${name} in ${unit} over time in ms: ${lines.map(({ title }) => title).join(', ')}`}
        timesMs={traces.times_ms.slice(first)}
        lines={lines}
        endMs={heartIsPlayed.value ? simulationEndMs.value : undefined}
        seeks={heartIsPlayed.value}
      />
    );
  };
  return (
    <>
      {chart('ml', 'Volumes')}
      {chart('kPa', 'Pressures')}
    </>
  );
}

function LastBeat() {
  const found = heartFound.value;
  const last = found?.beats.at(-1);
  if (!found || !last) return null;
  const [left, right] = ventricles.map((name) => figuresOf(last[name]));
  const change = found.change_percent === undefined ? null : `${short(found.change_percent)} %`;
  const beats = `${found.beats.length} ${found.beats.length === 1 ? 'beat' : 'beats'}`;
  return (
    <>
      <table class="measures tight" data-testid="last-beat">
        <thead>
          <tr>
            <th scope="col">Last beat</th>
            <th scope="col">Left</th>
            <th scope="col">Right</th>
          </tr>
        </thead>
        <tbody>
          {left.map(([name, title, value], i) => (
            <tr key={name}>
              <th scope="row" title={title}>
                {name}
              </th>
              <td>{value}</td>
              <td>{right[i][2]}</td>
            </tr>
          ))}
        </tbody>
      </table>
      <p class="hint" data-testid="limit-cycle">
        {found.has_cycle && `Limit cycle reached after ${beats}: volumes at its end change by ${change}.`}
        {!found.has_cycle &&
          change &&
          `No limit cycle yet after ${beats}: volumes at its end change by ${change}.`}
        {!found.has_cycle && !change && 'One beat does not show whether the next is the same.'}
      </p>
    </>
  );
}

/** This run as one that others are held against, by a name. */
function KeepRun() {
  const [name, setName] = useState('');
  if (!heartFound.value) return null;
  return (
    <form
      class="keep-run"
      onSubmit={(event) => {
        event.preventDefault();
        keepBeat(name);
        setName('');
      }}
    >
      <input
        type="text"
        aria-label="Name of this run"
        placeholder={`Run ${keptBeats.value.length + 1}`}
        value={name}
        onInput={(event) => setName(event.currentTarget.value)}
      />
      <button type="submit" class="button small" title="Its loops stay, and later ones are drawn over them">
        <Icon name="pin" size={13} /> Keep this run
      </button>
    </form>
  );
}

/** Runs that were kept beside this one: how much of their blood the ventricles eject. */
function KeptRuns() {
  const last = heartFound.value?.beats.at(-1);
  const percent = (part: number) => `${(100 * part).toFixed(1)} %`;
  if (keptBeats.value.length === 0) return null;
  return (
    <table class="measures tight kept-runs" data-testid="kept-runs">
      <thead>
        <tr>
          <th scope="col">Run</th>
          <th scope="col" title="Ejection fraction of the left ventricle">
            EF left
          </th>
          <th scope="col" title="Ejection fraction of the right ventricle">
            EF right
          </th>
          <th scope="col" title="Stroke volume of the left ventricle, ml">
            SV left
          </th>
          <th scope="col">
            <span class="sr">Remove</span>
          </th>
        </tr>
      </thead>
      <tbody>
        {last && (
          <tr>
            <th scope="row">
              <i class="run-colour" style={{ background: 'var(--chart-now)' }} /> This run
            </th>
            <td>{percent(last.lv.ejection_fraction)}</td>
            <td>{percent(last.rv.ejection_fraction)}</td>
            <td>{last.lv.stroke_ml.toFixed(1)}</td>
            <td />
          </tr>
        )}
        {keptBeats.value.map((kept) => (
          <tr key={kept.id}>
            <th scope="row">
              <i class="run-colour" style={{ background: keptColour(kept.id) }} />{' '}
              <input
                type="text"
                aria-label={`Name of kept run ${kept.id}`}
                value={kept.name}
                onInput={(event) => renameBeat(kept.id, event.currentTarget.value)}
              />
            </th>
            <td>{percent(kept.last.lv.ejection_fraction)}</td>
            <td>{percent(kept.last.rv.ejection_fraction)}</td>
            <td>{kept.last.lv.stroke_ml.toFixed(1)}</td>
            <td>
              <RemoveButton what={kept.name} onRemove={() => dropBeat(kept.id)} />
            </td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function Recorded({ traces }: { traces: Traces }) {
  return (
    <>
      <Loops traces={traces} />
      <LastBeat />
      <KeepRun />
      <KeptRuns />
      <OverTime traces={traces} />
      <button
        type="button"
        class="button small"
        title="All volumes, pressures and flows over time, for a spreadsheet"
        onClick={() => writeFiles(({ downloadHeartbeat }) => downloadHeartbeat(traces))}
      >
        <Icon name="download" size={13} /> CSV
      </button>
    </>
  );
}

/** What the heart does as it beats: loops and lines as they come, and what was found at the end. */
export function BeatFindings() {
  const traces = heartTraces.value;
  const filling = awaitsFrames.value && simulationOf.value === 'mechanics';
  return (
    <div class="beat-findings">
      {filling && <p class="hint">The ventricles are being filled before the first beat.</p>}
      {traces && <Recorded traces={traces} />}
    </div>
  );
}
