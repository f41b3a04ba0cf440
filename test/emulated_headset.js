// An emulated Quest 3 in a made-up room, for browser tests: IWER (iwer.js) goes before this.
// The room: a floor, a wall and a table, as Space Setup delivers them. Planes may be moved, the
// persistent anchors are limited to 8 as on the device, and the room scan is only counted.
;(() => {
  const { XRDevice, NativePlane, XRRigidTransform, metaQuest3 } = IWER
  const SIDE = Math.SQRT1_2

  // x, z: half lengths, m; a plane's y is its normal
  function plane(x, z, label, position, orientation = { x: 0, y: 0, z: 0, w: 1 }) {
    const polygon = [[-x, -z], [x, -z], [x, z], [-x, z]].map(
      ([across, along]) => new DOMPointReadOnly(across, 0, along, 1),
    )
    return new NativePlane(new XRRigidTransform(position, orientation), polygon, label)
  }

  const planes = new Set([
    plane(3, 3, 'floor', { x: 0, y: 0, z: 0 }),
    plane(3, 1.3, 'wall', { x: 0, y: 1.3, z: -3 }, { x: SIDE, y: 0, z: 0, w: SIDE }),
    plane(0.6, 0.4, 'table', { x: 0.2, y: 0.72, z: -1.1 }),
  ])
  const canvas = document.createElement('canvas')

  class MadeUpRoom {
    version = '1'
    planesVisible = false
    boundingBoxesVisible = false
    meshesVisible = false
    environmentCanvas = canvas
    trackedPlanes = planes
    trackedMeshes = new Set()
    render() {}
    loadEnvironment() {}
    loadDefaultEnvironment() {}
    deleteAll() {}
    computeHitTestResults() {
      return []
    }
    // m to the real room by place in the picture, 0 to 1 from its left and top; null: not measured
    computeDepthBuffer(_view, _projection, width, height) {
      if (headset.depth === null) return null
      const data = new Float32Array(width * height)
      for (let i = 0; i < data.length; i++) {
        data[i] = headset.depth(((i % width) + 0.5) / width, (Math.floor(i / width) + 0.5) / height)
      }
      return { data: data.buffer, width, height, rawValueToMeters: 1 }
    }
  }

  const device = new XRDevice(metaQuest3, { stereoEnabled: false })
  device.installRuntime({ forceInstall: true })
  device.installSEM(MadeUpRoom)
  device.position.set(0, 1.6, 0)
  window.headset = { device, planes, plane, depth: null }
})()
