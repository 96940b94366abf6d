// Runs in viser's page before viser's own code. Lets the page around the frame move the nodes of the scene in its own
// animation frames: viser's messages are handed to the client as if its socket worker had received them, so that the
// server need not stream poses. In a window of its own the scene has no page around it; there scene/window.js does the
// same from within.
(() => {
  'use strict';

  const CHANNEL = 'heli2dof-scene';
  const PATIENCE = 300;
  const MOVES = new Set([
    'SetOrientationMessage',
    'SetPositionMessage',
    'SetSceneNodeVisibilityMessage',
    'SceneNodeUpdateMessage',
    'SetCameraPositionMessage',
    'SetCameraLookAtMessage',
  ]);
  const framed = window.parent !== window;
  document.documentElement.dataset.place = framed ? 'frame' : 'window';

  // Viser's client obeys its address: ?websocket= would connect it to any server, and ?playbackPath= load any
  // recording, either of which may carry scripts into this origin.
  history.replaceState(null, '', location.pathname);

  /** @type {Worker | null} The worker that holds viser's socket. */
  let socketWorker = null;
  let state = { state: 'loading', reason: '' };
  /** How often the socket was opened or closed. */
  let connections = 0;
  /** @type {import('./pose.js').SceneMessage|undefined} Viser's own message about its colours. */
  let theme;

  /** @param {string} name @param {string} [reason] */
  function report(name, reason = '') {
    state = { state: name, reason };
    window.parent.postMessage({ channel: CHANNEL, ...state }, location.origin);
    if (name === 'ready') paint();
  }

  /** Hands messages to the client. @param {object[]} messages */
  function deliver(messages) {
    const batch = { type: 'message_batch', messages };
    socketWorker?.onmessage?.(new MessageEvent('message', { data: batch }));
  }

  /** The panel's colours follow the window's. */
  function paint() {
    const dark = document.documentElement.dataset.theme === 'dark';
    if (theme && !framed) deliver([{ ...theme, dark_mode: dark }]);
  }

  /**
   * Viser's client takes messages in its animation frames, the first camera among them, which would overrule a camera
   * that the page has sent before. So the scene is ready once its queue is empty.
   * @param {number} connection when it is another one, nobody waits any longer
   * @param {number} [frames] that are waited for at most, where viser tells nothing of its queue
   */
  function whenDrained(connection, frames = PATIENCE) {
    if (connection !== connections) return;
    const viser = /** @type {Window & {__viserMutable?: {messageQueue?: unknown[]}}} */ (window).__viserMutable;
    const messageQueue = viser?.messageQueue;
    if (messageQueue?.length === 0 || frames === 0) report('ready');
    else requestAnimationFrame(() => whenDrained(connection, frames - 1));
  }

  /**
   * Tells the page at once where the scene is seen from, in the rig's own axes (metres, z up), and where its picture is
   * within the frame, CSS px. The page takes hold of the rig by rays through it; three.js' own axes have y up. Where
   * viser does not show its camera, nothing is told.
   */
  function tellCamera() {
    const viser = /** @type {Window & {__viserMutable?: import('../flight/camera.js').Viser}} */ (window)
      .__viserMutable;
    const { camera, canvas } = viser ?? {};
    const root = viser?.nodeRefFromName?.[''];
    if (!camera || !canvas || !root) return;
    const inRig = (/** @type {[number, number, number]} */ ...seen) => {
      const { x, y, z } = root.worldToLocal(camera.localToWorld(camera.position.clone().set(...seen)));
      return [x, y, z];
    };
    const { left, top, width, height } = canvas.getBoundingClientRect();
    const data = {
      channel: CHANNEL,
      camera: {
        position: inRig(0, 0, 0),
        ahead: inRig(0, 0, -1),
        above: inRig(0, 1, 0),
        fov: (camera.fov * Math.PI) / 180,
        aspect: camera.aspect,
        box: [left, top, width, height],
      },
    };
    const { origin } = location;
    window.parent.dispatchEvent(new MessageEvent('message', { data, origin, source: window }));
  }

  /** @param {MessageEvent} event What the socket's worker tells the client. */
  function observe(event) {
    const { type, messages, closeReason } = event.data;
    if (type === 'connected' || type === 'closed') connections += 1;
    if (type === 'connected') {
      report('loading'); // The client has just emptied its scene; the replay follows.
    } else if (type === 'closed') {
      report('closed', closeReason);
    } else if (type === 'message_batch') {
      theme = messages.findLast((/** @type {{type: string}} */ m) => m.type === 'ThemeConfigurationMessage') ?? theme;
      // After a replay, and after a change of the rig, the nodes stand in their first pose.
      const rebuilt = messages.some(
        (/** @type {{type: string, name?: string}} */ m) =>
          m.type === 'ReplayDoneMessage' || (state.state === 'ready' && (m.name ?? '').startsWith('/rig')),
      );
      if (!rebuilt) return;
      if (state.state === 'ready') report('ready');
      else whenDrained(connections);
    }
  }

  const NativeWorker = window.Worker;
  window.Worker = class extends NativeWorker {
    /** @param {{type?: string}|undefined} message @param {Transferable[] & StructuredSerializeOptions} [options] */
    postMessage(message, options) {
      // Of viser's several workers only the socket's is told a server.
      if (message?.type === 'set_server' && socketWorker !== this) {
        socketWorker = this;
        this.addEventListener('message', observe);
      }
      super.postMessage(message, options);
    }
  };

  window.addEventListener('message', (event) => {
    if (event.source !== window.parent || event.origin !== location.origin) return;
    const data = event.data;
    if (data?.channel !== CHANNEL) return;
    if (data.kind === 'hello') {
      report(state.state, state.reason);
    } else if (data.kind === 'theme') {
      document.documentElement.dataset.theme = data.dark ? 'dark' : 'light';
      paint();
    } else if (data.kind === 'camera') {
      tellCamera();
    } else if (data.kind === 'pose' && state.state !== 'loading') {
      deliver(data.messages.filter((/** @type {{type: string}} */ m) => MOVES.has(m.type)));
    }
  });

  // Viser's sorter of splats makes functions from text when it loads, which the page's policy forbids. No scene here
  // has splats: what it gets is never called.
  const sorter = () => {
    throw new Error('functions are not made from text here');
  };
  window.Function = new Proxy(Function, { apply: () => () => sorter, construct: () => () => sorter });

  // In a frame the document has no focus until it is clicked, and viser's client would not reconnect until then.
  Document.prototype.hasFocus = function () {
    return !document.hidden;
  };

  // Over the rig a finger that goes up or down moves the page (touch-action), and so does a wheel, where the page
  // scrolls: the rig turns once the finger has gone sideways, and comes closer by Ctrl, as a touchpad's pinch has it.
  /** @type {Map<number, {x: number, y: number, turns: boolean}>} */
  const fingers = new Map();
  if (framed) {
    const early = (/** @type {string[]} */ types, /** @type {(event: PointerEvent) => void} */ act) => {
      for (const type of types)
        window.addEventListener(type, /** @type {EventListener} */ (act), { capture: true, passive: true });
    };
    early(['pointerdown'], ({ pointerType, pointerId, clientX: x, clientY: y }) => {
      if (pointerType === 'touch') fingers.set(pointerId, { x, y, turns: false });
    });
    early(['pointerup', 'pointercancel'], ({ pointerId }) => fingers.delete(pointerId));
    early(['pointermove'], (event) => {
      const finger = fingers.get(event.pointerId);
      if (!finger || finger.turns || fingers.size > 1) return;
      const [across, along] = [Math.abs(event.clientX - finger.x), Math.abs(event.clientY - finger.y)];
      finger.turns = across > 6 && across > along;
      if (!finger.turns) event.stopImmediatePropagation();
    });
    early(['wheel'], (event) => {
      const { scrollHeight, clientHeight } = window.parent.document.documentElement;
      if (!event.ctrlKey && scrollHeight > clientHeight + 1) event.stopImmediatePropagation();
    });
  }

  if (!framed) {
    const script = document.createElement('script');
    script.type = 'module';
    script.src = '../../static/scene/window.js';
    document.head.append(script);
  }
})();
