// The colour stops of a painted strip: along its tones, each a colour to pick.
import { control, element } from './control.js';

const hexOf = (colour) => `#${colour.map((part) =>
  Math.round(255 * Math.min(1, Math.max(0, part))).toString(16).padStart(2, '0')).join('')}`;
const colourOf = (hex) => [1, 3, 5].map((at) =>
  Number((parseInt(hex.slice(at, at + 2), 16) / 255).toFixed(4)));

/** [place, red, green, blue] of each. */
function stopsOf(values) {
  return Array.from({ length: Math.floor(values.length / 4) }, (_, i) => values.slice(4 * i, 4 * i + 4));
}

/** What lies at a place between two stops. */
function between([from, ...dark], [to, ...bright], place) {
  const share = (place - from) / (to - from);
  return [place, ...dark.map((part, i) => Number((part + (bright[i] - part) * share).toFixed(4)))];
}

/** As `control`: the numbers, and the same as colours. A click on the gradient adds a stop. */
export function stopsControl(parameter, turned) {
  let stops = [];
  const numbers = control(parameter, (values) => {
    show(values);
    turned(values);
  });
  const track = element('div', { className: 'track', title: 'a click adds a colour' });
  const list = element('div', {});

  const drawTrack = () => {
    const parts = stops.map(([place, ...colour]) => `${hexOf(colour)} ${100 * place}%`);
    track.style.background = stops.length > 1 ? `linear-gradient(to right, ${parts})` : '';
  };
  const changed = () => {
    drawTrack();
    numbers.write(stops.flat());
    turned(stops.flat());
  };
  const changedList = () => {
    changed();
    list.replaceChildren(...stops.map(row));
  };

  function row(stop, i) {
    const isEnd = i === 0 || i === stops.length - 1;
    const colour = element('input', { type: 'color', value: hexOf(stop.slice(1)) });
    colour.oninput = () => {
      stop.splice(1, 3, ...colourOf(colour.value));
      changed();
    };
    const place = element('input', { type: 'range', min: 0, max: 1, step: 0.001, value: stop[0], disabled: isEnd });
    place.oninput = () => { // stays between its neighbours
      stop[0] = Math.min(stops[i + 1][0] - 0.001, Math.max(stops[i - 1][0] + 0.001, Number(place.value)));
      stop[0] = Number(stop[0].toFixed(4));
      changed();
    };
    const remove = element('button', { textContent: '×', title: 'remove this colour', disabled: isEnd });
    remove.onclick = () => {
      stops.splice(i, 1);
      changedList();
    };
    colour.setAttribute('aria-label', `colour ${i + 1}`);
    place.setAttribute('aria-label', `place of colour ${i + 1}`);
    remove.setAttribute('aria-label', `remove colour ${i + 1}`);
    return element('div', { className: 'stop' }, colour, place, remove);
  }

  track.onclick = (event) => {
    const place = Number((event.offsetX / track.clientWidth).toFixed(3));
    const next = stops.findIndex(([at]) => at > place);
    if (next < 1 || stops[next - 1][0] === place) return;
    stops.splice(next, 0, between(stops[next - 1], stops[next], place));
    changedList();
  };

  function show(values) {
    stops = stopsOf(values);
    drawTrack();
    list.replaceChildren(...stops.map(row));
  }
  const write = (values) => {
    numbers.write(values);
    show(values);
  };
  return { parts: [...numbers.parts, element('div', { className: 'choice' }, track, list)], write };
}
