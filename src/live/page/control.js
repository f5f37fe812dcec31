// Inputs for parameters, whatever they are of.

/** TOML spells these as JSON does. */
export const spell = (value) => JSON.stringify(value);

/** A new element with its properties and children. */
export function element(name, properties = {}, ...children) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}

/** An input for a parameter: the elements, and functions that read and write its value. */
export function control(parameter, turned) {
  const { type, range, choices } = parameter;
  if (type === 'true/false') {
    const box = element('input', { type: 'checkbox', className: 'wide' });
    box.oninput = () => turned(box.checked);
    return { parts: [box], write: (value) => (box.checked = value) };
  }
  if (type === 'choice') {
    const list = element('select', { className: 'wide' }, ...choices.map((c) => new Option(c)));
    list.oninput = () => turned(list.value);
    return { parts: [list], write: (value) => (list.value = value) };
  }
  if (type === 'number' || type === 'integer') return numberControl(parameter, turned);
  const field = element('input', { className: 'wide' });
  field.onchange = () => {
    if (type === 'text') return turned(field.value);
    try {
      turned(JSON.parse(`[${field.value}]`));
      field.setCustomValidity('');
    } catch {
      field.setCustomValidity(type === 'texts' ? 'names in quotes, with commas' : 'numbers, with commas');
      field.reportValidity();
    }
  };
  const one = (v) => (typeof v === 'number' ? Number(v.toPrecision(7)) : spell(v));
  const write = (value) => (field.value = type === 'text' ? value : value.map(one).join(', '));
  return { parts: [field], write };
}

/** Wide ranges slide finely near 0: the slider is the cube root of its way through the range. */
function numberControl({ type, range: [low, high] = [0, 1] }, turned) {
  const wide = high - low > 1000;
  const bend = wide ? 3 : 1;
  const slider = element('input', { type: 'range', min: 0, max: 1, step: 'any' });
  const field = element('input', { type: 'number', min: low, max: high, step: 'any' });
  const round = (v) => (type === 'integer' ? Math.round(v) : Number(v.toPrecision(4)));
  slider.oninput = () => {
    field.value = round(low + (high - low) * slider.value ** bend);
    turned(Number(field.value));
  };
  field.onchange = () => field.value !== '' && turned(Number(field.value));
  const write = (value) => {
    field.value = Number(value.toPrecision(7));
    slider.value = ((value - low) / (high - low)) ** (1 / bend);
  };
  return { parts: [slider, field], write };
}
