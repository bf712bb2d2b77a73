import { useEffect, useRef, useState } from 'preact/hooks';
import { volume } from '../store/input';
import { layout, legend, sliceLegend } from '../store/view';
import { EmptyState } from './empty_state';
import { LegendCard, PickedCard } from './view_cards';
import { ShowAll, SliceChoice, ViewToolbar } from './view_tools';

export function ViewPanel() {
  const host = useRef<HTMLDivElement>(null);
  const [trouble, setTrouble] = useState('');
  const opened = volume.value !== null;
  useEffect(() => {
    if (!opened || !host.current) return;
    const element = host.current;
    let unmount: (() => void) | undefined;
    let gone = false;
    import('../scene/scene').then(
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
  }, [opened]);

  return (
    <main class="view" aria-label="View" data-layout={opened ? layout.value : undefined}>
      {opened && <ViewToolbar />}
      <div class="view-body">
        <div class="view-host" ref={host} />
        {!opened && <EmptyState />}
        {trouble && <p class="view-trouble">{trouble}</p>}
        {opened && (
          <>
            <LegendCard shown={legend.value ?? (layout.value === 'model' ? sliceLegend.value : null)} />
            <SliceChoice />
            <PickedCard />
            <ShowAll />
          </>
        )}
      </div>
    </main>
  );
}
