// A drive in three dimensions. The engine makes the scene, as binary glTF with its motion; three.js
// shows it at a time. Nothing is computed here but where the eye is.

import { element, four } from "./dom.js";

/** @typedef {typeof import("three")} Three */

/** The angle of view from top to bottom [°]. */
const VIEW = 36;
/** Where the eye is at first: its angle around the vertical, and that from it [rad]. */
const EYE = { around: 0.6, down: 1.15 };
/** A time after the end of every animation [s]. */
const END = 1e6;
/** How far a key turns the view [rad], and how much nearer or farther it goes. */
const STEP = { turn: Math.PI / 36, zoom: 1.15 };
/** How far the view turns over the width of the picture [rad]. */
const DRAG = Math.PI;
/** How much of what is under the ground is hidden by what: wheels are seen in their soil. */
const HIDES = /** @type {Record<string, number>} */ ({ soil: 0.6, track: 0.5 });

/** The names of wheels. */
const WHEEL = /[ _]wheel$/;

/** What the keys do to the view: how far it turns around and down, and how much nearer it goes. */
const KEYS = /** @type {Record<string, [number, number, number]>} */ ({
  ArrowLeft: [-STEP.turn, 0, 1], ArrowRight: [STEP.turn, 0, 1], ArrowUp: [0, -STEP.turn, 1], ArrowDown: [0, STEP.turn, 1],
  "+": [0, 0, 1 / STEP.zoom], "=": [0, 0, 1 / STEP.zoom], "-": [0, 0, STEP.zoom],
});

/** @type {boolean | undefined} */
let isAble;
/** Whether the browser can show anything in three dimensions. */
export function hasDepth() {
  if (isAble === undefined) {
    const context = document.createElement("canvas").getContext("webgl2");
    context?.getExtension("WEBGL_lose_context")?.loseContext();
    isAble = context !== null;
  }
  return isAble;
}

/** @param {string} keys that turn the view */
const helpOf = (keys) => `Drag, or use ${keys}, to turn the view. Two fingers, + and −, or the wheel of the mouse after a click come nearer and go away.`;

/** Loads three.js, once. */
async function load() {
  const [three, { GLTFLoader }] = await Promise.all([import("three"), import("three/addons/loaders/GLTFLoader.js")]);
  return { three, GLTFLoader };
}

/** The picture of a drive in three dimensions. */
export class DriveScene {
  /** @param {(problem: string) => void} failed */
  constructor(failed) {
    this.failed = failed;
    /** Which scene is waited for. */
    this.turn = 0;
    /** What is shown. @type {import("three").Object3D | undefined} */
    this.root = undefined;
    /** @type {import("three").Object3D | undefined} */
    this.rover = undefined;
    /** @type {import("three").AnimationMixer | undefined} */
    this.mixer = undefined;
    /** @type {import("three").AnimationAction | undefined} */
    this.action = undefined;
    /** What draws it. @type {{renderer: import("three").WebGLRenderer, scene: import("three").Scene, camera: import("three").PerspectiveCamera, three: Three} | undefined} */
    this.stage = undefined;
    /** @type {HTMLCanvasElement | undefined} */
    this.canvas = undefined;
    /** Seconds of the run in a second of its animation. */
    this.pace = 1;
    /** The time that is shown [s]. */
    this.time = 0;
    this.isFollowing = true;
    /** Whether the arrow keys drive the rover, and turn the view with Shift alone. */
    this.isDriven = false;
    /** How the rover stands, where no animation says so. @type {Record<string, any> | undefined} */
    this.standing = undefined;
    /** The way so far, in the ground's frame. @type {[number, number, number][]} */
    this.way = [];
    /** @type {import("three").Line | undefined} */
    this.trail = undefined;
    this.eye = { ...EYE, distance: 1 };
    /** @type {import("three").Vector3 | undefined} */
    this.target = undefined;
    this.drawing = 0;
    /** Height of the rover's centre of mass in the scene [m]. */
    this.height = 0;
    /** @type {Map<number, [number, number]>} the fingers on the picture */
    this.fingers = new Map();
    this.follow = element("button", { type: "button", id: "follow", "aria-pressed": "true", onclick: () => {
      this.isFollowing = !this.isFollowing;
      this.follow.setAttribute("aria-pressed", String(this.isFollowing));
      this.frame();
    } }, ["Follow the rover"]);
    /** @type {import("three").Object3D[]} the arrows of the wheels' forces, in the wheels' order */
    this.arrows = [];
    /** The force of an arrow of 1 m [N]. */
    this.newtons = 0;
    this.hasForces = true;
    this.scale = element("span", { id: "force-scale" });
    this.forces = element("label", { class: "box", title: "The soil's force on each wheel, from the ground under it" }, [
      element("input", { type: "checkbox", id: "forces", checked: true, onchange: (/** @type {any} */ event) => {
        this.hasForces = event.target.checked;
        this.showForces();
        this.draw();
      } }), " Forces",
    ]);
    this.again = element("button", { type: "button", onclick: () => this.frame() }, ["Reset the view"]);
    this.place = element("div", { class: "stage" });
    this.words = element("p", { class: "setup", id: "scene-words" });
    this.help = element("figcaption", {}, [helpOf("the arrow keys")]);
    this.element = element("figure", { class: "scene", "aria-label": "The drive in three dimensions", "aria-busy": "false", hidden: true }, [
      this.place,
      element("div", { class: "choice" }, [this.follow, this.again, this.forces, this.scale]),
      this.words,
      this.help,
    ]);
    this.sizes = new ResizeObserver(() => this.draw());
    this.darkness = matchMedia("(prefers-color-scheme: dark)");
    this.redraw = () => this.draw();
  }

  /** Leaves the arrow keys to a drive. */
  leaveArrows() {
    this.isDriven = true;
    this.help.textContent = helpOf("Shift with the arrow keys");
  }

  /** A scene is on its way. */
  wait() {
    this.turn += 1;
    this.element.setAttribute("aria-busy", "true");
  }

  /**
   * Shows another scene.
   * @param {string} content binary glTF in base64
   */
  async take(content) {
    this.wait();
    const { turn } = this;
    try {
      const { three, GLTFLoader } = await load();
      const bytes = Uint8Array.from(atob(content), (letter) => letter.charCodeAt(0));
      const { scene: root, animations } = await new GLTFLoader().parseAsync(bytes.buffer, "");
      if (turn !== this.turn) {
        release(root);
        return;
      }
      this.remove();
      const stage = this.stage ?? this.begin(three);
      const [clip] = animations;
      this.root = root;
      this.rover = root.getObjectByName("rover");
      root.traverse((part) => {
        const { material } = part;
        const place = Object.keys(HIDES).indexOf(material?.name ?? "");
        if (!material || place < 0) return;
        // Tracks are drawn over the soil.
        part.renderOrder = 1 + place;
        material.transparent = true;
        material.opacity = HIDES[material.name] ?? 1;
      });
      stage.scene.add(root);
      this.arrows = partsOf(root, /^force[ _]/);
      for (const arrow of this.arrows) {
        // They begin under wheels, which would hide them, and are drawn after the soil.
        arrow.renderOrder = 9;
        if (arrow.material) Object.assign(arrow.material, { depthTest: false, transparent: true });
      }
      this.newtons = Number(clip?.userData["newtons_per_metre"] ?? 0);
      this.showForces();
      if (clip) {
        this.pace = Number(clip.userData["run_seconds_per_second"] ?? 1);
        this.mixer = new three.AnimationMixer(root);
        this.action = this.mixer.clipAction(clip).setLoop(three.LoopOnce, 1);
        // At its end it stays.
        this.action.clampWhenFinished = true;
        this.action.play();
      }
      if (this.isDriven) {
        // The wheels have their places at the end of it.
        this.at(END);
        this.height = this.rover?.position.z ?? 0;
        if (this.standing) this.stand(this.standing);
      } else this.at(this.time);
      if (!this.target) this.frame();
      this.element.setAttribute("aria-busy", "false");
    } catch (error) {
      if (turn === this.turn) this.failed(`The drive cannot be shown in three dimensions: ${/** @type {Error} */ (error).message}`);
    }
  }

  /**
   * Makes what draws.
   * @param {Three} three
   */
  begin(three) {
    const canvas = /** @type {HTMLCanvasElement} */ (element("canvas", { tabindex: 0, role: "application", "aria-label": `The drive in three dimensions: ${this.isDriven ? "Shift with arrow keys turns" : "arrow keys turn"} the view, plus and minus zoom`, "aria-describedby": "scene-words" }));
    const renderer = new three.WebGLRenderer({ canvas, antialias: true });
    const scene = new three.Scene();
    const sun = new three.DirectionalLight(0xffffff, 1.5);
    sun.position.copy(new three.Vector3(-0.5, 1, 0.7));
    scene.add(new three.HemisphereLight(0xffffff, 0x8a8378, 1.4), sun);
    this.stage = { renderer, scene, camera: new three.PerspectiveCamera(VIEW), three };
    this.canvas = canvas;
    this.listen(canvas);
    this.place.replaceChildren(canvas);
    this.sizes.observe(this.place);
    this.darkness.addEventListener("change", this.redraw);
    return this.stage;
  }

  /** @param {HTMLCanvasElement} canvas */
  listen(canvas) {
    canvas.addEventListener("keydown", (event) => {
      const move = KEYS[event.key];
      if (!move || event.ctrlKey || event.metaKey || event.altKey) return;
      if (this.isDriven && event.key.startsWith("Arrow") && !event.shiftKey) return;
      event.preventDefault();
      this.move(...move);
    });
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      this.fingers.set(event.pointerId, [event.clientX, event.clientY]);
    });
    const gone = (/** @type {PointerEvent} */ event) => this.fingers.delete(event.pointerId);
    canvas.addEventListener("pointerup", gone);
    canvas.addEventListener("pointercancel", gone);
    canvas.addEventListener("pointermove", (event) => {
      const before = this.fingers.get(event.pointerId);
      if (!before) return;
      const now = /** @type {[number, number]} */ ([event.clientX, event.clientY]);
      this.fingers.set(event.pointerId, now);
      const other = [...this.fingers].find(([id]) => id !== event.pointerId)?.[1];
      if (other) {
        const apart = (/** @type {number[]} */ [x = 0, y = 0]) => Math.max(1, Math.hypot(x - other[0], y - other[1]));
        this.move(0, 0, apart(before) / apart(now));
      } else {
        const perPixel = DRAG / canvas.clientWidth;
        this.move((before[0] - now[0]) * perPixel, (before[1] - now[1]) * perPixel, 1);
      }
    });
    canvas.addEventListener("wheel", (event) => {
      // Elsewhere the wheel moves the page.
      if (document.activeElement !== canvas) return;
      event.preventDefault();
      this.move(0, 0, STEP.zoom ** Math.sign(event.deltaY));
    }, { passive: false });
    canvas.addEventListener("webglcontextrestored", this.redraw);
  }

  /**
   * Turns the view, and goes nearer or farther.
   * @param {number} around [rad]
   * @param {number} down [rad]
   * @param {number} farther
   */
  move(around, down, farther) {
    this.eye.around += around;
    this.eye.down = Math.min(1.55, Math.max(0.05, this.eye.down + down));
    this.eye.distance *= farther;
    this.draw();
  }

  /** Has the rover in view, or all of the ground. */
  frame() {
    const { stage, root } = this;
    if (!stage || !root) return;
    const { Box3, Sphere, Vector3 } = stage.three;
    const seen = new Box3().setFromObject(this.isFollowing ? this.rover ?? root : root).getBoundingSphere(new Sphere());
    this.target = new Vector3().copy(seen.center);
    this.eye = { ...EYE, distance: seen.radius / Math.sin((VIEW * Math.PI) / 360) };
    this.draw();
  }

  /**
   * Shows a time of the run.
   * @param {number} time [s]
   */
  at(time) {
    this.time = time;
    const { mixer, action, rover } = this;
    if (!mixer || !action || !rover) return;
    // One that came to its end stands still.
    action.reset();
    mixer.setTime(time / this.pace);
    this.tell(rover);
    this.draw();
  }

  /** Shows the arrows or not, and says their scale. */
  showForces() {
    for (const arrow of this.arrows) arrow.visible = this.hasForces;
    this.scale.textContent = this.hasForces && this.arrows.length ? `Arrows are the soil's forces on the wheels: 1 m of arrow = ${four(this.newtons)} N` : "";
  }

  /**
   * Has the arrows point as a record has the forces.
   * @param {Record<string, any>[]} wheels
   * @param {Three} three
   */
  point(wheels, { Vector3 }) {
    for (const [place, arrow] of this.arrows.entries()) {
      const force = new Vector3(...["drawbar_pull_n", "side_force_n", "normal_force_n"].map((of) => wheels[place]?.[of] ?? 0));
      const length = force.length() / this.newtons;
      // One that has no size has no direction, either.
      arrow.scale.set(1, 1, length || 1e-9);
      if (length) arrow.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), force.normalize());
    }
  }

  /**
   * Has the rover stand as a record has it, with its way behind it. On a plane its height stays that of
   * the scene, and so do the arms of a suspension on a map.
   * @param {Record<string, any>} record
   */
  stand(record) {
    this.standing = record;
    const { rover, stage } = this;
    if (!rover || !stage) return;
    const { three } = stage;
    const angle = (/** @type {string} */ of) => Math.PI / 180 * (record[of] ?? 0);
    rover.position.set(record["x_m"], record["y_m"], record["z_m"] ?? this.height);
    rover.setRotationFromEuler(new three.Euler(angle("roll_deg"), -angle("pitch_deg"), angle("yaw_deg"), "ZYX"));
    for (const [place, wheel] of partsOf(rover, WHEEL).entries()) {
      wheel.setRotationFromEuler(new three.Euler(0, record["turned_rad"]?.[place] ?? 0, 0));
    }
    this.point(record["wheels"] ?? [], three);
    this.follows(rover);
    this.tell(rover);
    this.draw();
  }

  /**
   * Draws the way behind the rover.
   * @param {import("three").Object3D} rover
   */
  follows(rover) {
    const { stage, trail } = this;
    if (trail) {
      trail.removeFromParent();
      release(trail);
    }
    this.trail = undefined;
    if (!stage || !rover.parent || this.way.length < 2) return;
    const { BufferGeometry, Line, LineBasicMaterial, Vector3 } = stage.three;
    const colour = getComputedStyle(this.place).getPropertyValue("--second").trim();
    const places = this.way.map((at) => new Vector3(...at));
    this.trail = new Line(new BufferGeometry().setFromPoints(places), new LineBasicMaterial({ color: colour }));
    rover.parent.add(this.trail);
  }

  /**
   * Says in words where the rover is.
   * @param {import("three").Object3D} rover
   */
  tell(rover) {
    const wheels = partsOf(rover, WHEEL);
    const axes = /** @type {("x" | "y" | "z")[]} */ (["x", "y", "z"]);
    this.words.replaceChildren(
      "A rover with ", element("span", { "data-column": "scene-wheels" }, [String(wheels.length)]), " wheels, its centre of mass at ",
      ...axes.flatMap((axis, place) => [`${place ? ", " : ""}${axis} `, element("span", { "data-column": `scene-${axis}_m` }, [four(rover.position[axis])]), " m"]),
    );
  }

  /** Draws once for all that changed since the last picture. */
  draw() {
    if (this.drawing || !this.stage) return;
    this.drawing = requestAnimationFrame(() => {
      this.drawing = 0;
      const { stage, place, eye, target } = this;
      const [width, height] = [place.clientWidth, place.clientHeight];
      if (!stage || !target || !width || !height) return;
      const { renderer, scene, camera, three } = stage;
      if (this.isFollowing && this.rover) this.rover.getWorldPosition(target);
      renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
      renderer.setSize(width, height, false);
      camera.aspect = width / height;
      [camera.near, camera.far] = [eye.distance / 20, eye.distance * 200];
      camera.updateProjectionMatrix();
      camera.position.setFromSphericalCoords(eye.distance, eye.down, eye.around).add(target);
      camera.lookAt(target);
      scene.background = new three.Color(getComputedStyle(place).getPropertyValue("--panel").trim());
      renderer.render(scene, camera);
    });
  }

  /** Removes what is shown, and frees its memory. */
  remove() {
    this.mixer?.stopAllAction();
    if (this.root) {
      this.mixer?.uncacheRoot(this.root);
      this.stage?.scene.remove(this.root);
      release(this.root);
    }
    this.root = this.rover = this.mixer = this.action = this.trail = undefined;
    this.arrows = [];
    this.showForces();
    this.words.replaceChildren();
  }

  /** There is no drive. */
  clear() {
    this.turn += 1;
    this.remove();
    this.element.setAttribute("aria-busy", "false");
    this.draw();
  }

  /** Ends, and frees all memory. */
  close() {
    this.clear();
    cancelAnimationFrame(this.drawing);
    this.drawing = 0;
    this.sizes.disconnect();
    this.darkness.removeEventListener("change", this.redraw);
    this.stage?.renderer.dispose();
    this.stage?.renderer.forceContextLoss();
    this.stage = this.canvas = this.target = undefined;
    this.fingers.clear();
    this.place.replaceChildren();
  }
}

/**
 * The parts of a scene whose names are such, in their order.
 * @param {import("three").Object3D} root
 * @param {RegExp} name
 */
function partsOf(root, name) {
  /** @type {import("three").Object3D[]} */
  const parts = [];
  root.traverse((part) => {
    if (name.test(part.name)) parts.push(part);
  });
  return parts;
}

/**
 * Frees the memory of what is no more shown.
 * @param {import("three").Object3D} root
 */
function release(root) {
  root.traverse(({ geometry, material }) => {
    geometry?.dispose();
    material?.dispose();
  });
}
