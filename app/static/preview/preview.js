/**
 * The 3D preview: shows a plan's poses in the embedded Viser client.
 *
 * All poses of a plan come once, as one binary; a moved playhead costs no message to the server.
 *
 *   const frame = document.querySelector("iframe");
 *   frame.src = Preview.url();                     // "/viser/?websocket=ws://HOST/viser/ws"
 *   const preview = new Preview(frame);
 *   await preview.ready();
 *   await preview.loadPoses(`/api/gaits/${id}/poses?plan=${hash}`);   // or an ArrayBuffer
 *   playback.addEventListener("time", (event) => preview.setTime(event.detail.time));
 *
 * Static:
 *   Preview.url(options)          address for the iframe; options: { dark: false }
 * Methods:
 *   ready(timeoutMs = 20000)      Promise: the scene of the robot is in the client; rejects with a sentence
 *   loadPoses(source)             Promise<{ robot, duration, frames, nodes }>: URL string or ArrayBuffer; the
 *                                 playhead's time stays. A newer call wins over one still under way (whose
 *                                 promise then resolves to null).
 *   setTime(seconds)              shows the pose at that time, interpolated; cheap, call it every frame
 *   setOverlay(overlay | null)    what lies on the floor; loadPoses sets it by itself where the poses carry one:
 *                                 { times: [n] s, com: [n][3] m, feet: [n][legs][3] m, contact: [n][legs] bool,
 *                                   margins: [n] m }   null takes it away
 *   show(part, visible)           part: "polygon", "com", "traces", "footholds", "robot"
 *   setCaution(metres)            margin below which the polygon is amber (0.003 by default; below 0 it is red)
 *   setDark(dark)                 backdrop and grid for the dark theme
 *   setView(name)                 "perspective", "top", "front", "side"
 *   dispose()
 * Properties: time, info (of the loaded plan or null), route ("direct", "server" or "none"), posesShown (count).
 * Events: "ready" (also after a reconnection), "lost" (the client lost its server), "route".
 */

export class Preview extends EventTarget {}
