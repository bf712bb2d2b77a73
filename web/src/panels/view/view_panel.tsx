import { volume } from '../../store/case/input';
import { simulation } from '../../store/run/frames';
import { layout } from '../../store/view';
import { EmptyState } from '../case/empty_state';
import { fetched } from '../controls/fetched';
import { SceneHost } from './scene_host';
import { ReadingNote, ReadingState, SurfaceNote, volumeComes } from './under_way';
import { ViewCards } from './view_cards';
import { ShowAll, SliceChoice, ToolOptions, ViewButtons, ViewToolbar } from './view_tools';

const PlayerBar = fetched(() => import('./player_bar').then((part) => part.PlayerBar));

export function ViewPanel() {
  const opened = volume.value !== null;
  const comes = volumeComes();
  return (
    <main id="part-view" class="view" aria-label="View" data-layout={opened ? layout.value : undefined}>
      {opened && <ViewToolbar />}
      <div class="view-body">
        <SceneHost shown={opened && !comes} />
        {comes ? <ReadingState /> : !opened && <EmptyState />}
        {opened && (
          <>
            <ToolOptions />
            <ViewButtons />
            <ViewCards />
            {!comes && <SliceChoice />}
            <SurfaceNote />
            <ReadingNote />
            <ShowAll />
          </>
        )}
      </div>
      {opened && simulation.value !== 'none' && <PlayerBar />}
    </main>
  );
}
