// What the page uses of three (npm), whose package has no types.

declare module "three" {
  export class Vector3 {
    constructor(x?: number, y?: number, z?: number);
    x: number;
    y: number;
    z: number;
    add(other: Vector3): this;
    set(x: number, y: number, z: number): this;
    copy(other: Vector3): this;
    length(): number;
    normalize(): this;
    setFromSphericalCoords(radius: number, phi: number, theta: number): this;
  }
  export class Euler {
    constructor(x: number, y: number, z: number, order?: string);
  }
  export class Quaternion {
    setFromUnitVectors(from: Vector3, to: Vector3): this;
  }
  export class Color {
    constructor(colour: string);
  }
  export class Sphere {
    center: Vector3;
    radius: number;
  }
  export class Box3 {
    setFromObject(object: Object3D): this;
    getBoundingSphere(sphere: Sphere): Sphere;
  }
  export interface Material {
    name: string;
    opacity: number;
    transparent: boolean;
    dispose(): void;
  }
  export class Object3D {
    name: string;
    children: Object3D[];
    parent: Object3D | null;
    position: Vector3;
    quaternion: Quaternion;
    scale: Vector3;
    visible: boolean;
    renderOrder: number;
    geometry?: { dispose(): void };
    material?: Material;
    add(...objects: Object3D[]): this;
    remove(...objects: Object3D[]): this;
    removeFromParent(): this;
    setRotationFromEuler(euler: Euler): void;
    getObjectByName(name: string): Object3D | undefined;
    getWorldPosition(target: Vector3): Vector3;
    lookAt(at: Vector3): void;
    traverse(each: (object: Object3D) => void): void;
    updateMatrixWorld(force?: boolean): void;
  }
  export class Group extends Object3D {}
  export class BufferGeometry {
    setFromPoints(points: Vector3[]): this;
    dispose(): void;
  }
  export class LineBasicMaterial implements Material {
    constructor(parameters: { color: string });
    name: string;
    opacity: number;
    transparent: boolean;
    dispose(): void;
  }
  export class Line extends Object3D {
    constructor(geometry: BufferGeometry, material: Material);
  }
  export class Scene extends Object3D {
    background: Color | null;
  }
  export class HemisphereLight extends Object3D {
    constructor(sky: number, ground: number, intensity: number);
  }
  export class DirectionalLight extends Object3D {
    constructor(colour: number, intensity: number);
  }
  export class PerspectiveCamera extends Object3D {
    constructor(fov: number);
    aspect: number;
    near: number;
    far: number;
    updateProjectionMatrix(): void;
  }
  export class WebGLRenderer {
    constructor(settings: { canvas: HTMLCanvasElement; antialias: boolean });
    setPixelRatio(ratio: number): void;
    setSize(width: number, height: number, setsStyle: boolean): void;
    render(scene: Scene, camera: PerspectiveCamera): void;
    dispose(): void;
    forceContextLoss(): void;
  }
  export interface AnimationClip {
    userData: Record<string, unknown>;
  }
  export interface AnimationAction {
    clampWhenFinished: boolean;
    play(): this;
    reset(): this;
    setLoop(mode: number, repetitions: number): this;
  }
  export class AnimationMixer {
    constructor(root: Object3D);
    clipAction(clip: AnimationClip): AnimationAction;
    setTime(seconds: number): this;
    stopAllAction(): this;
    uncacheRoot(root: Object3D): void;
  }
  export const LoopOnce: number;
}

declare module "three/addons/loaders/GLTFLoader.js" {
  import type { AnimationClip, Group } from "three";

  export class GLTFLoader {
    parseAsync(data: ArrayBuffer, path: string): Promise<{ scene: Group; animations: AnimationClip[] }>;
  }
}
