import { expectation, report } from '../../store/run/report';
import { fetched } from '../controls/fetched';
import { Panel } from '../controls/panel';

const Evidence = fetched(() => import('./evidence').then((part) => part.Evidence));
const VerdictCard = fetched(() => import('./verdict_card').then((part) => part.VerdictCard));

export function EvidencePanel() {
  const found = report.value;
  return (
    <Panel part="evidence" class="right" label="Evidence">
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
      {found && <Evidence found={found} />}
    </Panel>
  );
}
