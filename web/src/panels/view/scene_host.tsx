import { useEffect, useRef, useState } from 'preact/hooks';
import { activity } from '../../store/run/stages';

/** Where the scene is mounted; `shown` once there is something to see. */
export function SceneHost({ shown }: { shown: boolean }) {
  const host = useRef<HTMLDivElement>(null);
  const [trouble, setTrouble] = useState('');
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
    <>
      <div class={shown ? 'view-host' : 'view-host waiting'} ref={host} />
      {shown && trouble && <p class="view-trouble">{trouble}</p>}
    </>
  );
}
