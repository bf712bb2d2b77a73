/** A text of a lesson, in one line or several. */
export function TextField(props: {
  label: string;
  value: string | undefined;
  rows?: number;
  placeholder?: string;
  onChange(text: string): void;
}) {
  const { label, value = '', rows, placeholder } = props;
  const shared = {
    value,
    placeholder,
    onInput: (event: { currentTarget: { value: string } }) => props.onChange(event.currentTarget.value),
  };
  return (
    <label class="edit-text">
      <span>{label}</span>
      {rows ? <textarea rows={rows} {...shared} /> : <input type="text" {...shared} />}
    </label>
  );
}
