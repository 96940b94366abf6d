// Runs in viser's page before viser's own code. Lets the page around the frame move the nodes of
// the scene in its own animation frames: viser's messages are handed to the client as if its socket
// worker had received them, so that the server need not stream poses.
(() => {
  "use strict";

  const CHANNEL = "heli2dof-scene";
  const MOVES = new Set([
    "SetOrientationMessage",
    "SetPositionMessage",
    "SetSceneNodeVisibilityMessage",
    "SceneNodeUpdateMessage",
    "SetCameraPositionMessage",
    "SetCameraLookAtMessage",
  ]);
  const framed = window.parent !== window;

  // Viser's client obeys its address: ?websocket= would connect it to any server, and
  // ?playbackPath= load any recording, either of which may carry scripts into this origin.
  history.replaceState(null, "", location.pathname);

  /** @type {Worker | null} The worker that holds viser's socket. */
  let socketWorker = null;
  let state = { state: "loading", reason: "" };

  /** @param {string} name @param {string} [reason] */
  function report(name, reason = "") {
    state = { state: name, reason };
    if (framed) window.parent.postMessage({ channel: CHANNEL, ...state }, location.origin);
  }

  /** @param {MessageEvent} event What the socket's worker tells the client. */
  function observe(event) {
    const { type, messages, closeReason } = event.data;
    if (type === "connected") {
      report("loading"); // The client has just emptied its scene; the replay follows.
    } else if (type === "closed") {
      report("closed", closeReason);
    } else if (type === "message_batch") {
      // After a replay, and after a change of the rig, the nodes stand in their first pose.
      const rebuilt = messages.some(
        (/** @type {{type: string, name?: string}} */ m) =>
          m.type === "ReplayDoneMessage" ||
          (state.state === "ready" && (m.name ?? "").startsWith("/rig")),
      );
      if (rebuilt) report("ready");
    }
  }

  const NativeWorker = window.Worker;
  window.Worker = class extends NativeWorker {
    /** @param {any} message @param {any} [options] */
    postMessage(message, options) {
      // Of viser's several workers only the socket's is told a server.
      if (message?.type === "set_server" && socketWorker !== this) {
        socketWorker = this;
        this.addEventListener("message", observe);
      }
      super.postMessage(message, options);
    }
  };

  window.addEventListener("message", (event) => {
    if (!framed || event.source !== window.parent || event.origin !== location.origin) return;
    const data = event.data;
    if (data?.channel !== CHANNEL) return;
    if (data.kind === "hello") {
      report(state.state, state.reason);
    } else if (data.kind === "theme") {
      document.documentElement.dataset.theme = data.dark ? "dark" : "light";
    } else if (data.kind === "pose" && state.state !== "loading" && socketWorker?.onmessage) {
      const messages = data.messages.filter((/** @type {any} */ m) => MOVES.has(m.type));
      const batch = { type: "message_batch", messages };
      socketWorker.onmessage(new MessageEvent("message", { data: batch }));
    }
  });

  // In a frame the document has no focus until it is clicked, and viser's client would not
  // reconnect until then.
  Document.prototype.hasFocus = function () {
    return !document.hidden;
  };
})();
