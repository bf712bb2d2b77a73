import type { LabelFidelity, LayerCount, TransferredLabel, Report } from '../../engine/contract';
import { distanceText, percent, topologyRow, type TopologyCell } from './fidelity_text';
import { short } from '../controls/format';
import { colourOf, nameOf } from '../../store/case/legend/legend';

type Fidelity = NonNullable<Report['fidelity']>;

function LabelName({ label }: { label: number }) {
  return (
    <th scope="row">
      <svg class="dot" viewBox="0 0 8 8" aria-hidden="true">
        <circle cx="4" cy="4" r="4" fill={colourOf.value(label)} />
      </svg>
      {nameOf(label)}
    </th>
  );
}

function Heads({ first = 'Label', numbers }: { first?: string; numbers: string[] }) {
  return (
    <thead>
      <tr>
        <th scope="col">{first}</th>
        {numbers.map((name) => (
          <th key={name} scope="col" class="num">
            {name}
          </th>
        ))}
      </tr>
    </thead>
  );
}

function LabelTable({ labels }: { labels: LabelFidelity[] }) {
  return (
    <div class="table-scroll" tabIndex={0} role="region" aria-label="Fidelity to the labels">
      <table class="measures">
        <Heads numbers={['Volume', 'Dice', 'Edge mm']} />
        <tbody>
          {labels.map((row) => (
            <tr key={row.label}>
              <LabelName label={row.label} />
              <td
                class="num"
                title={`${short(row.mesh_mm3 / 1000)} ml meshed, ${short(row.voxel_mm3 / 1000)} ml in voxels`}
              >
                {percent(row.volume_error_percent)}
              </td>
              <td class="num" title="the mesh sampled at voxel centres against the voxels">
                {row.dice.toFixed(3)}
              </td>
              <td class="num" title="median edge length / median target edge length">
                {short(row.median_edge_mm)} / {short(row.target_edge_mm)}
              </td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

function Cell({ cell }: { cell: TopologyCell }) {
  return <td class={cell.changed ? 'num changed' : 'num'}>{cell.text}</td>;
}

function TopologyTable({ found }: { found: Fidelity['topology'] }) {
  const count = found.differences.length;
  const kept = count === 0;
  return (
    <>
      <h3>
        Topology{' '}
        <span class={kept ? 'tag pass' : 'tag caution'}>
          {kept ? 'kept' : `${count} ${count === 1 ? 'difference' : 'differences'}`}
        </span>
      </h3>
      <div class="table-scroll" tabIndex={0} role="region" aria-label="Topology of the labels">
        <table class="measures" data-testid="topology">
          <Heads numbers={['Pieces', 'Cavities', 'Tunnels', 'Pinched']} />
          <tbody>
            {found.labels.map(topologyRow).map((row) => (
              <tr key={row.label}>
                <LabelName label={row.label} />
                <Cell cell={row.components} />
                <Cell cell={row.cavities} />
                <Cell cell={row.handles} />
                <Cell cell={row.pinched} />
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      {!kept && (
        <details class="more">
          <summary>Every difference in words</summary>
          <ul class="warnings">
            {found.differences.map((difference) => (
              <li key={difference}>{difference}</li>
            ))}
          </ul>
        </details>
      )}
      <p class="facts">
        Label surface → mesh. The label surface joins voxels over 14 neighbours (marching tetrahedra), or over
        6 (marching cubes, a single label).
      </p>
    </>
  );
}

function TransferTable({ labels }: { labels: TransferredLabel[] }) {
  const cell = (found: { error_percent: number; dice?: number }) => (
    <td class="num" title={found.dice === undefined ? undefined : `Dice ${found.dice.toFixed(3)}`}>
      {percent(found.error_percent)}
    </td>
  );
  return (
    <>
      <h3>Label transfer</h3>
      <div class="table-scroll" tabIndex={0} role="region" aria-label="Labels transferred">
        <table class="measures" data-testid="transfer">
          <Heads numbers={['Shares', 'Centroid', 'Majority']} />
          <tbody>
            {labels.map((row) => (
              <tr key={row.label}>
                <LabelName label={row.label} />
                {cell(row.by_fraction)}
                {cell(row.by_centroid)}
                {cell(row.by_majority)}
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      <p class="facts">
        Volume that the tetrahedra give a label by its share of each, or whole by the label at the centroid or
        of most of it; against its voxels.
      </p>
    </>
  );
}

function LayerTable({ walls }: { walls: LayerCount[] }) {
  const share = (part: number) => <td class="num">{(100 * part).toFixed(1)} %</td>;
  return (
    <>
      <h3>Elements across walls</h3>
      <div class="table-scroll" tabIndex={0} role="region" aria-label="Elements across walls">
        <table class="measures" data-testid="layers">
          <Heads first="Wall" numbers={['Target', 'Exactly', 'At least']} />
          <tbody>
            {walls.map(({ wall, target_layers, by_edges }) => (
              <tr key={wall.join()}>
                <th scope="row">{wall.map(nameOf).join(', ')}</th>
                <td class="num">{target_layers}</td>
                {share(by_edges.exact)}
                {share(by_edges.at_least)}
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      <p class="facts">
        Share of the outer area with the target number of edges from the outer surface to the inner one, and
        with no fewer.
      </p>
    </>
  );
}

export function FidelitySection({ found, fidelity }: { found: Report; fidelity: Fidelity }) {
  const { labels, topology, mesh_to_surface: there, surface_to_mesh: back } = fidelity;
  return (
    <section class="section">
      <h2>Fidelity to the labels</h2>
      <LabelTable labels={labels} />
      <p class="facts">
        Distance of each label's boundary to the label surface: {distanceText(there)}; back:{' '}
        {distanceText(back)}.
      </p>
      <TopologyTable found={topology} />
      {found.layers && <LayerTable walls={found.layers} />}
      {found.transfer && <TransferTable labels={found.transfer} />}
    </section>
  );
}
