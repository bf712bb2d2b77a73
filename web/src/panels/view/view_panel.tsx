import { useEffect, useRef, useState } from 'preact/hooks';
import { volume } from '../../store/case/input';
import { simulation } from '../../store/run/frames';
import { activity } from '../../store/run/stages';
import { layout } from '../../store/view';
import { EmptyState } from '../case/empty_state';
import { fetched } from '../controls/fetched';
import { ReadingNote, ReadingState, SurfaceNote, volumeComes } from './under_way';
import { ViewCards } from './view_cards';
import { ShowAll, SliceChoice, ToolOptions, ViewButtons, ViewToolbar } from './view_tools';

const PlayerBar = fetched(() => import('./player_bar').then((part) => part.PlayerBar));

export function ViewPanel() {
  const host = useRef<HTMLDivElement>(null);
  const [trouble, setTrouble] = useState('');
  const opened = volume.value !== null;
  const comes = volumeComes();
  // Ready before there is anything to see, but not in the way of the engine's start.
  const started = activity.value !== 'starting';
  useEffect(() => {
    if (!started || !host.current) return;
    const element = host.current;
    let unmount: (() => void) | undefined;
    let gone = false;
    import('../../scene/scene').then(
      ({ mountScene }) => {
        if (gone) return;
        try {
          unmount = mountScene(element);
        } catch {
          setTrouble(
            'This browser gives no WebGL 2, so there is no 3-D view. Meshing, histograms and export work all the same.',
          );
        }
      },
      () => setTrouble('The 3-D view could not be loaded.'),
    );
    return () => {
      gone = true;
      unmount?.();
    };
  }, [started]);

  return (
    <main id="part-view" class="view" aria-label="View" data-layout={opened ? layout.value : undefined}>
      {opened && <ViewToolbar />}
      <div class="view-body">
        <div class={opened && !comes ? 'view-host' : 'view-host waiting'} ref={host} />
        {comes ? <ReadingState /> : !opened && <EmptyState />}
        {opened && trouble && <p class="view-trouble">{trouble}</p>}
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
