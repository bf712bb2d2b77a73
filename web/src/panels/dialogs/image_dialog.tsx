/** What is a file whose values look like those of an image? */
import { useMemo, useState } from 'preact/hooks';
import { otsu, valuesOf } from '../../geometry/image_threshold';
import { takeVolume } from '../../store/case/open_case';
import { imageAsked, openFiles } from '../../store/case/open_files';
import { readAgain, readingOf } from '../../store/case/reading';
import { defaults } from '../../store/run/stages';
import type { Series } from '../../report/charts';
import { Dialog } from '../controls/dialog';
import { NumberInput } from '../controls/fields';
import { FileInput } from '../controls/file_input';
import { whole } from '../controls/format';
import { HistogramChart } from '../controls/histogram';

type Asked = NonNullable<typeof imageAsked.value>;

function Threshold({ asked }: { asked: Asked }) {
  const values = useMemo(() => (asked.summary ? valuesOf(asked.summary) : null), [asked]);
  const series = useMemo<Series[]>(
    () => (values ? [{ name: 'Voxels', histogram: values.histogram, tone: 'now' }] : []),
    [values],
  );
  const [lower, setLower] = useState<number | null>(values ? Math.ceil(otsu(values.histogram)) : null);
  const [upper, setUpper] = useState<number | null>(values ? values.largest : null);
  const ready = lower !== null && upper !== null && lower <= upper;
  const read = async () => {
    const source = defaults.value?.source;
    if (!source || !ready) return;
    const done = await readAgain({ ...readingOf(source), threshold: { lower, upper } }, asked.file);
    if (done) imageAsked.value = null;
  };
  return (
    <>
      <h3>Make one structure of it</h3>
      {values && (
        <HistogramChart
          title="Values of the image"
          unit=""
          of="voxels"
          series={series}
          selected={ready ? [lower, upper] : null}
          onSelect={(from, to) => {
            setLower(Math.round(from));
            setUpper(Math.round(to));
          }}
        />
      )}
      <div class="dialog-row">
        <span>Values from</span>
        <NumberInput label="Smallest value" value={lower} onChange={setLower} />
        <span>to</span>
        <NumberInput label="Largest value" value={upper} onChange={setUpper} />
        <button type="button" class="button primary" disabled={!ready} onClick={() => void read()}>
          Take them as label 1
        </button>
      </div>
    </>
  );
}

export function ImageDialog({ asked }: { asked: Asked }) {
  const { file, summary, message } = asked;
  const close = () => (imageAsked.value = null);
  return (
    <Dialog title="Is this an image, not a segmentation?" onClose={close}>
      <p>
        {summary
          ? `${file.name} holds ${whole(summary.labels.length)} values that change from voxel to voxel, like brightness. `
          : `${message}. `}
        A mesh is made from labels: one whole number for each structure.
      </p>
      <Threshold asked={asked} />
      <h3>Or</h3>
      <div class="dialog-actions">
        <FileInput
          class="button"
          testId="other-file"
          onFiles={(files) => {
            close();
            void openFiles(files);
          }}
        >
          Open the segmentation instead…
        </FileInput>
        {summary && (
          <button
            type="button"
            class="button"
            onClick={() => {
              close();
              takeVolume(summary, file.name);
            }}
          >
            They are labels: go on
          </button>
        )}
        <button type="button" class="button" onClick={close}>
          Cancel
        </button>
      </div>
    </Dialog>
  );
}
