#pragma once

#include "live/http_server.h"
#include "live/live_page.h"
#include "live/live_session.h"

// The room of `kagefude live`: a look on some frames, kept in memory with everything that was made
// on the way, and a page on the loopback that turns its knobs. Includes point one way: cli -> live
// -> compositor; within the room page -> session -> frame -> stages -> keys.
//
// What is made of what. A frame runs through the compositor's own functions, the very ones that
// composeFrame calls; there is no second implementation that could drift. Each call is a stage with
// a key: the version of every earlier result that it takes, and the value of every setting that it
// takes, written out whole (stage_key.h). Equal keys mean equal bits, for passes are pure functions
// and give the same bits for any threads; so a stage is made again when its key differs, and only
// then.
//
//   stage       function                     key beside the versions of what it takes
//   read        readFramePlanes              files (time, size, inode), [frame], channels asked for
//   sample      sampleFrame                  step (only where the frame is larger than --size)
//   colour      Colour                       the configuration's file
//   strips      StripSet                     names and files of the strips, colour.strip; only
//   those
//                                            that changed are loaded
//   surfaces    labelSurfaces                [surfaces]
//   shadow      the method of each light     the light's place, size, masks, method; its passes
//   smoothing   smoothWithinSurfaces         [smooth] (where the method's row asks for it)
//   tone of     lightTone                    [shade], [merge], shadow.strength, the light's weight
//   sum         sumTones                     merge.lights, tone.light, all weights
//   styles      styleSurfaces                [scene], lights, [brush], [outline], [edges], [tint],
//                                            [tone], [[style]]
//   tone        adjustTone                   the [tone] of each anchor
//   strokes     paintStyles                  as styles, but for outlines, tone and albedo; whether
//                                            any edges are painted
//   picture     finishPicture, scaleDown     output.background, output.edges, output.scale,
//                                            [ground], [paper], strips
//
// A key may name more than its stage needs (a light's shadow counts the parameters of all methods):
// that costs a stage for a knob that does nothing. It must never name less: tests/live turns every
// key of every table and compares with composeFrame bit for bit, so a parameter that is added and
// forgotten here fails there.
//
// What is let go. A stage keeps its last result and nothing older; lights that take no part any
// more lose theirs; of the frames the last few that were looked at are kept. A picture that is
// shown (or stored to be compared with) holds its own stages by shared pointers until the viewer
// lets go. So memory depends on frames and lights, not on how often a knob was turned.
//
// Proxies. While the hand moves, frames larger than --size are looked at through every n-th pixel:
// data is sampled, never blended (proxy.h says why), lengths in pixels shrink with it, and the same
// stages run on the small planes. When the hand rests, the stages of full size run in the
// background, between two of which they give way to a new change; the longer they will take, the
// longer must the hand rest (0.2 to 1 s). Full size is not a zoomed proxy: it is the same functions
// on the frame's own planes, with the look's own lengths, hence equal to `comp`.
//
// Pace. A knob that takes longer than the hand waits (LiveSession::Settings::pace, 25 ms of making;
// the way of 1024 × 576 pixels to the eye takes another 30 of the 60 ms) shows every 2nd, 4th or
// 8th of those samples in both ways until the hand rests; the fewer, the longer may they take. How
// many is learnt for each knob from what its last picture took, so it is the machine's and the
// frame's own; a light that moves is traced anew and begins at every 4th. While the hand rests, the
// proxies are brought up to date, so that the first turn makes nothing but what it changes.
//
// No queue. A change replaces the one that waits; a page asks for the next picture when it has
// drawn the last.
//
// Trust. The page is code of ours in a browser that also holds pages of others. What comes in is
// refused unless it comes from the page itself (page_guard.h), is bounded (http_server.h), and can
// name no file but strips in the look's folder (page_paths.h).
