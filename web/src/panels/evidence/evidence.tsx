import type { Report } from '../../engine/contract';
import { pinned } from '../../store/run/compare';
import { writeFiles } from '../controls/write_files';
import { alignment, upToDate } from '../../store/run/report';
import { CopyButton } from '../controls/copy_button';
import { dialogShown } from '../controls/dialog_shown';
import { fetched } from '../controls/fetched';
import { Checklist } from './checklist';
import { CompareSection } from './compare_section';
import { ElementHistograms } from './element_histograms';
import { FidelitySection } from './fidelity_section';
import { notesOf } from './fidelity_text';
import { short, whole } from '../controls/format';
import { Icon } from '../controls/icons';
import { MeasuresTable } from './measures_table';
import { WorstList } from './worst_list';

const AlignmentSection = fetched(() => import('./alignment_section').then((part) => part.AlignmentSection));

function Summary({ found }: { found: Report }) {
  const angles = found.quality.metrics.find((metric) => metric.name === 'min_dihedral_deg');
  return (
    <section class="section summary">
      <dl>
        <div>
          <dt>Tetrahedra</dt>
          <dd data-testid="tets">{whole(found.tets)}</dd>
        </div>
        <div>
          <dt>Points</dt>
          <dd>{whole(found.points)}</dd>
        </div>
        {angles && (
          <div>
            <dt>Smallest angle</dt>
            <dd>{short(angles.min)}°</dd>
          </div>
        )}
      </dl>
      {!upToDate.value && (
        <p class="stale">The recipe has changed since this mesh was made. Run to bring it up to date.</p>
      )}
    </section>
  );
}

function Messages({ title, messages }: { title: string; messages: string[] }) {
  if (messages.length === 0) return null;
  return (
    <section class="section">
      <h2>{title}</h2>
      <ul class="warnings">
        {messages.map((message) => (
          <li key={message}>{message}</li>
        ))}
      </ul>
    </section>
  );
}

/** All that a run's report shows: summary, checks, charts, comparison. */
export function Evidence({ found }: { found: Report }) {
  return (
    <>
      <Summary found={found} />
      <Checklist found={found} />
      <CompareSection found={found} />
      <ElementHistograms
        found={found}
        pinned={pinned.value?.report === found ? null : (pinned.value?.report ?? null)}
      />
      <WorstList found={found} />
      {found.fidelity && <FidelitySection found={found} fidelity={found.fidelity} />}
      {alignment.value && <AlignmentSection found={alignment.value} />}
      <MeasuresTable found={found} />
      <Messages title="Warnings" messages={found.warnings} />
      <Messages title="Notes" messages={notesOf(found)} />
      <section class="section">
        <h2>Report</h2>
        <p class="digest">
          Digest <code title={found.digest}>{found.digest.slice(0, 12)}…</code>
          <CopyButton class="icon-button small" label="Copy the digest" text={found.digest}>
            <Icon name="copy" size={14} />
          </CopyButton>
        </p>
        <div class="compare-actions">
          <button type="button" class="button small" onClick={() => (dialogShown.value = 'review')}>
            Reviewer's page…
          </button>
          <button
            type="button"
            class="button small"
            onClick={() => writeFiles(({ downloadReport }) => downloadReport())}
          >
            <Icon name="download" size={13} /> JSON
          </button>
        </div>
      </section>
    </>
  );
}
