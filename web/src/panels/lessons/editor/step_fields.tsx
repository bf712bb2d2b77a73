import { draft, editStep, takeCase, takePicture, takeView, written } from '../../../lessons/draft';
import type { Step } from '../../../lessons/lesson';
import { hasSource, recipe } from '../../../store/case/recipe';
import { controlNames, type ControlName } from '../../../store/case/keep/lesson_asked';
import { tellError } from '../../../store/run/engine';
import { sceneMounted } from '../../../store/view';
import { CheckField } from '../../controls/fields';
import { FileInput } from '../../controls/file_input';
import { RemoveButton } from '../../controls/folded_item';
import { Icon } from '../../controls/icons';
import { writeFiles } from '../../controls/write_files';
import { QuestionFields } from './question_fields';
import { TextField } from './text_field';
import { ValueFields } from './value_fields';

const controlWords: Record<ControlName, string> = {
  source: 'Volume',
  labels: 'Labels',
  sizes: 'Element size',
  cuts: 'Flat cuts',
  physics: 'Physics',
  volume: 'Parameters: volume',
  surface: 'Parameters: label surface',
  smooth: 'Parameters: smoothing',
  remesh: 'Parameters: adapted surface',
  tetra: 'Parameters: tetrahedra',
  optimise: 'Parameters: better shapes',
  quality: 'Parameters: evidence',
  run: 'Run',
  evidence: 'Evidence',
  export: 'Export',
};

function PictureFields({ picture }: { picture: Step['picture'] }) {
  const take = (blob: Blob | undefined) => void (blob && takePicture(blob).catch(tellError));
  return (
    <>
      <div class="edit-bounds">
        <FileInput class="button small" testId="picture-file" onFiles={([file]) => take(file)}>
          Picture…
        </FileInput>
        <button
          type="button"
          class="button small"
          disabled={!sceneMounted.value || !recipe.value || !hasSource(recipe.value)}
          onClick={() => writeFiles(({ viewPicture }) => viewPicture().then(take))}
        >
          Picture of the view
        </button>
        {picture && <RemoveButton what="picture" onRemove={() => editStep({ picture: undefined })} />}
      </div>
      {picture && (
        <>
          <img class="lesson-picture" src={picture.source} alt={picture.alt} />
          <TextField
            label="What the picture shows, for whoever does not see it"
            value={picture.alt}
            onChange={(alt) => editStep({ picture: { ...picture, alt } })}
          />
        </>
      )}
    </>
  );
}

/** Case and view of the page, as they are now, come with the step. */
function SceneFields({ step }: { step: Step }) {
  const open = recipe.value !== null && hasSource(recipe.value);
  return (
    <>
      <CheckField
        label="Opens the case that is open now"
        hint="Without a case of its own a step goes on with that of the step before"
        checked={step.case !== undefined}
        onChange={(on) => (on && open ? void takeCase().catch(tellError) : editStep({ case: undefined }))}
      />
      <CheckField
        label="Sets the view as it is now"
        checked={step.view !== undefined}
        onChange={(on) => (on ? takeView() : editStep({ view: undefined }))}
      />
    </>
  );
}

function AllowFields({ allow }: { allow: Step['allow'] }) {
  return (
    <>
      <CheckField
        label="Everything may be used"
        checked={allow === undefined}
        onChange={(all) => editStep({ allow: all ? undefined : ['run', 'evidence'] })}
      />
      {allow && (
        <div class="edit-controls" role="group" aria-label="What may be used">
          {controlNames.map((name) => (
            <CheckField
              key={name}
              label={controlWords[name]}
              checked={allow.includes(name)}
              onChange={(on) =>
                editStep({ allow: controlNames.filter((one) => (one === name ? on : allow.includes(one))) })
              }
            />
          ))}
        </div>
      )}
    </>
  );
}

function ShowFields({ show = [] }: { show: Step['show'] }) {
  return (
    <>
      {show.map((ref, i) => (
        <div key={i} class="edit-check">
          <ValueFields
            name={`Shown value ${i + 1}`}
            chosen={ref}
            onChange={(next) => editStep({ show: show.with(i, next) })}
          />
          <button type="button" class="button small" onClick={() => editStep({ show: show.toSpliced(i, 1) })}>
            Do not show
          </button>
        </div>
      ))}
      <button
        type="button"
        class="button small"
        disabled={show.length >= 8}
        onClick={() => editStep({ show: [...show, { value: 'mesh.tets' }] })}
      >
        <Icon name="plus" size={13} /> Value beside the text
      </button>
    </>
  );
}

export function StepFields() {
  const step = draft.value.steps[written.value];
  return (
    <>
      <TextField label="Title of the step" value={step.title} onChange={(title) => editStep({ title })} />
      <TextField
        label="Text"
        rows={5}
        value={step.text}
        placeholder={'Paragraphs, lists with "- ", *emphasis*, `code`'}
        onChange={(text) => editStep({ text })}
      />
      <SceneFields step={step} />
      <QuestionFields question={step.question} />
      {step.question && (
        <>
          <TextField label="Said when right" value={step.right} onChange={(right) => editStep({ right })} />
          {step.question.kind !== 'do' && (
            <TextField label="Said when wrong" value={step.wrong} onChange={(wrong) => editStep({ wrong })} />
          )}
          <TextField
            label="Hints, one a line"
            rows={2}
            value={step.hints?.join('\n')}
            onChange={(text) => editStep({ hints: text === '' ? undefined : text.split('\n') })}
          />
        </>
      )}
      <details class="more">
        <summary>Picture</summary>
        <PictureFields picture={step.picture} />
      </details>
      <details class="more">
        <summary>What may be used</summary>
        <AllowFields allow={step.allow} />
      </details>
      <details class="more">
        <summary>Values beside the text</summary>
        <ShowFields show={step.show} />
      </details>
    </>
  );
}
