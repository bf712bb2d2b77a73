import type { FunctionComponent } from 'preact';
import { useEffect, useState } from 'preact/hooks';
import { tellError } from '../../store/run/engine';

/** A component whose code is fetched when it is first shown: what few people need does not make everybody wait. */
export function fetched<Props extends object>(
  load: () => Promise<FunctionComponent<Props>>,
): FunctionComponent<Props> {
  let fetchedOnce: FunctionComponent<Props> | null = null;
  return function Fetched(props) {
    const [Shown, setShown] = useState(() => fetchedOnce);
    useEffect(() => {
      if (fetchedOnce) return;
      load().then((component) => {
        fetchedOnce = component;
        setShown(() => component);
      }, tellError);
    }, []);
    return Shown && <Shown {...props} />;
  };
}
