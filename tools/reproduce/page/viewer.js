// Viewers: one large frame over a strip of panes, all with the same pan and zoom. A pane has its picture and, but for the
// references, layers over it: differences and FLIP.
'use strict';

const kMostZoom = 64;
const viewers = [...document.querySelectorAll('.viewer')].map(makeViewer);
let active = viewers[0];

function makeViewer(root) {
  const panes = [...root.querySelectorAll('.pane')];
  const imageButtons = [...root.querySelectorAll('button[data-image]')];
  const layerButtons = [...root.querySelectorAll('button[data-layer]')];
  const large = root.querySelector('.large');
  const view = { x: 0, y: 0, zoom: 1 };
  const state = { image: Number(root.dataset.first), layer: 'picture', reference: false };

  const layerOf = (pane, layer) => pane.querySelector(`img[data-layer="${layer}"]`) || pane.querySelector('img');

  function show() {
    const pane = panes[state.reference ? 0 : state.image];
    const shown = layerOf(pane, state.layer);
    large.querySelector('img').src = shown.src;
    large.querySelector('.shown').textContent = shown.alt;
    panes.forEach((p, i) => {
      p.setAttribute('aria-current', i === state.image);
      p.querySelectorAll('img').forEach(image => { image.hidden = image !== layerOf(p, state.layer); });
    });
    imageButtons.forEach((b, i) => b.setAttribute('aria-pressed', i === (state.reference ? 0 : state.image)));
    layerButtons.forEach(b => b.setAttribute('aria-pressed', b.dataset.layer === state.layer));
  }

  function place() {
    const least = 1 - view.zoom;
    view.x = Math.min(0, Math.max(least, view.x));
    view.y = Math.min(0, Math.max(least, view.y));
    for (const [name, value] of Object.entries(view)) root.style.setProperty(`--${name}`, value);
    root.classList.toggle('near', view.zoom * large.clientWidth > large.querySelector('img').naturalWidth);
  }

  const viewer = {
    choose(image) { if (image < panes.length) { state.image = image; state.reference = false; show(); } },
    step(by) { viewer.choose((state.image + by + panes.length) % panes.length); },
    layer(layer) { if (layerButtons.some(b => b.dataset.layer === layer)) { state.layer = layer; show(); } },
    flip() { state.reference = !state.reference; show(); },
    // (px, py): what stays in place, in shares of the frame.
    zoom(factor, px, py) {
      const zoom = Math.min(kMostZoom, Math.max(1, view.zoom * factor));
      view.x = px - (px - view.x) * zoom / view.zoom;
      view.y = py - (py - view.y) * zoom / view.zoom;
      view.zoom = zoom;
      place();
    },
    pan(dx, dy) { view.x += dx; view.y += dy; place(); },
    fit() { Object.assign(view, { x: 0, y: 0, zoom: 1 }); place(); },
  };

  imageButtons.forEach((b, i) => b.addEventListener('click', () => viewer.choose(i)));
  layerButtons.forEach(b => b.addEventListener('click', () => viewer.layer(b.dataset.layer)));
  root.querySelector('button[data-fit]').addEventListener('click', viewer.fit);
  const flipButton = root.querySelector('button[data-flip]');
  if (flipButton) flipButton.addEventListener('click', viewer.flip);
  root.addEventListener('pointerenter', () => { active = viewer; });
  // A button that was clicked does not keep the space bar for itself.
  root.addEventListener('click', event => { if (event.detail > 0) document.activeElement.blur(); });
  panes.forEach((pane, i) => attach(pane.querySelector('.frame'), viewer, () => viewer.choose(i)));
  attach(large, viewer, viewer.flip);
  show();
  new ResizeObserver(place).observe(large);
  return viewer;
}

// Wheel zooms at the pointer, dragging pans, a click without dragging does `clicked`.
function attach(frame, viewer, clicked) {
  let from = null, moved = false;
  frame.addEventListener('wheel', event => {
    event.preventDefault();
    const box = frame.getBoundingClientRect();
    viewer.zoom(Math.exp(-event.deltaY / 300), (event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height);
  }, { passive: false });
  frame.addEventListener('pointerdown', event => {
    from = [event.clientX, event.clientY];
    moved = false;
    frame.setPointerCapture(event.pointerId);
  });
  frame.addEventListener('pointermove', event => {
    if (!from) return;
    const dx = event.clientX - from[0], dy = event.clientY - from[1];
    if (!moved && Math.hypot(dx, dy) < 4) return;
    moved = true;
    const box = frame.getBoundingClientRect();
    viewer.pan(dx / box.width, dy / box.height);
    from = [event.clientX, event.clientY];
  });
  frame.addEventListener('pointerup', () => { if (from && !moved) clicked(); from = null; });
  frame.addEventListener('pointercancel', () => { from = null; });
}

document.addEventListener('keydown', event => {
  if (!active || event.ctrlKey || event.altKey || event.metaKey) return;
  if (event.key === ' ' && event.target.closest('button, summary, a')) return;
  const actions = {
    ' ': active.flip, r: active.flip, p: () => active.layer('picture'), d: () => active.layer('difference'),
    s: () => active.layer('same'), f: () => active.layer('flip'), '0': active.fit, '+': () => active.zoom(1.5, 0.5, 0.5),
    '-': () => active.zoom(1 / 1.5, 0.5, 0.5), ArrowLeft: () => active.step(-1), ArrowRight: () => active.step(1),
  };
  const action = actions[event.key] || (event.key >= '1' && event.key <= '9' ? () => active.choose(event.key - 1) : null);
  if (!action) return;
  event.preventDefault();
  action();
});
