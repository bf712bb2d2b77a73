import type { Report } from '../../engine/contract';
import { pinned } from '../../store/run/compare';
import { writeFiles } from '../controls/write_files';
import { alignment, expectation, report, upToDate } from '../../store/run/report';
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
const VerdictCard = fetched(() => import('./verdict_card').then((part) => part.VerdictCard));

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

export function EvidencePanel() {
  const found = report.value;
  return (
    <aside class="panel right" aria-label="Evidence">
      {expectation.value && <VerdictCard />}
      {!found && (
        <div class="panel-empty">
          <svg viewBox="0 0 120 56" width="120" height="56" aria-hidden="true">
            {[8, 14, 26, 40, 46, 38, 24, 15, 9, 5].map((bar, i) => (
              <rect key={i} x={4 + i * 11.4} y={52 - bar} width="8.4" height={bar} rx="1.5" />
            ))}
          </svg>
          <h2>Evidence</h2>
          <p>
            After a run: the checklist, edge length against target edge length, aspect ratios before and
            after, dihedral angles, and the fidelity to the labels.
          </p>
        </div>
      )}
      {found && (
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
            <div class="compare-actions">
              <button
                type="button"
                class="button small"
                onClick={() => writeFiles(({ downloadReportPage }) => downloadReportPage())}
              >
                <Icon name="download" size={13} /> Page with pictures
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
      )}
    </aside>
  );
}
