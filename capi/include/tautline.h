/* Tautline's chain of robots for programs in C: see docs/embed.md. Written by cbindgen; a test
   compares it. */

#ifndef TAUTLINE_H
#define TAUTLINE_H

#include <stddef.h>
#include <stdint.h>

/*
 The most robots of a chain, the base counted.
 */
#define TAUTLINE_CHAIN_ROBOTS 16

/*
 The most columns and rows of an area.
 */
#define TAUTLINE_CHAIN_CELLS 16

/*
 The size of a chain in words of 8 bytes.
 */
#define TAUTLINE_CHAIN_WORDS 128

/*
 The chain as the paper publishes it.
 */
#define TAUTLINE_RULE_PUBLISHED 0

/*
 The chain with the repairs of its refuted claims.
 */
#define TAUTLINE_RULE_REPAIRED 1

/*
 The repaired chain that reels itself in and out instead of taking moves back.
 */
#define TAUTLINE_RULE_REEL 2

/*
 A plan that seeks new cells.
 */
#define TAUTLINE_KIND_ADVANCE 0

/*
 A plan that takes an earlier move back.
 */
#define TAUTLINE_KIND_BACKTRACK 1

/*
 The robot goes one column east.
 */
#define TAUTLINE_STEP_EAST 0

/*
 The robot goes one row south.
 */
#define TAUTLINE_STEP_SOUTH 1

/*
 The robot goes one column west.
 */
#define TAUTLINE_STEP_WEST 2

/*
 The robot goes one row north.
 */
#define TAUTLINE_STEP_NORTH 3

/*
 The robot stays.
 */
#define TAUTLINE_STEP_STAY 4

/*
 The status of a call: 0 or more if it did what it is for, less than 0 if it refused to.
 */
enum TautlineStatus
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /*
   The call did what it is for.
   */
  TAUTLINE_STATUS_OK = 0,
  /*
   The run is over: every cell of the area is explored.
   */
  TAUTLINE_STATUS_EXPLORED = 1,
  /*
   The run is over: the team can explore nothing more.
   */
  TAUTLINE_STATUS_EXHAUSTED = 2,
  /*
   A pointer that must not be null is null.
   */
  TAUTLINE_STATUS_NULL_POINTER = -1,
  /*
   The memory holds no chain, or no monitor.
   */
  TAUTLINE_STATUS_NOT_BEGUN = -2,
  /*
   There is no such rule.
   */
  TAUTLINE_STATUS_UNKNOWN_RULE = -3,
  /*
   A chain is a base and at least one robot, and a monitor has at least one.
   */
  TAUTLINE_STATUS_TOO_FEW_ROBOTS = -4,
  /*
   A chain here has at most 16 robots, the base counted.
   */
  TAUTLINE_STATUS_TOO_MANY_ROBOTS = -5,
  /*
   The last cell lies before the first one, or the area has more than 16 columns or rows.
   */
  TAUTLINE_STATUS_BAD_AREA = -6,
  /*
   The base is outside the area.
   */
  TAUTLINE_STATUS_BASE_OUTSIDE = -7,
  /*
   There is no plan to settle.
   */
  TAUTLINE_STATUS_NO_PLAN = -8,
  /*
   A caller's array is too small; nothing has happened.
   */
  TAUTLINE_STATUS_TOO_SMALL = -9,
  /*
   A byte of the log or a message is no message.
   */
  TAUTLINE_STATUS_DAMAGED_BYTE = -10,
  /*
   There are not as many bytes as the team has sent.
   */
  TAUTLINE_STATUS_DAMAGED_LENGTH = -11,
  /*
   The log says that a move was taken back which cannot have been.
   */
  TAUTLINE_STATUS_DAMAGED_TAKEN_BACK = -12,
  /*
   By the log, robots would lose contact.
   */
  TAUTLINE_STATUS_DAMAGED_OUT_OF_CONTACT = -13,
  /*
   By the log, three robots would be in one cell.
   */
  TAUTLINE_STATUS_DAMAGED_CROWDED = -14,
  /*
   By the log, a robot would not come back to the base.
   */
  TAUTLINE_STATUS_DAMAGED_NOT_HOME = -15,
  /*
   A message is about another step than the plan has.
   */
  TAUTLINE_STATUS_DAMAGED_OTHER_STEP = -16,
  /*
   A message contradicts what the team knows.
   */
  TAUTLINE_STATUS_DAMAGED_OTHER_WORLD = -17,
  /*
   There is no such demand, or positions say nothing of it with its tolerance.
   */
  TAUTLINE_STATUS_BAD_DEMAND = -18,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum TautlineStatus TautlineStatus;
#else
typedef int32_t TautlineStatus;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/*
 A chain and the memory that it needs. A caller reads and writes nothing in it, and may copy it as a whole.
 */
typedef struct {
  uint64_t mark;
  uint64_t memory[TAUTLINE_CHAIN_WORDS];
} TautlineChain;

/*
 A cell: its column, counted eastwards, and its row, counted southwards.
 */
typedef struct {
  /*
   The column.
   */
  int16_t x;
  /*
   The row.
   */
  int16_t y;
} TautlineCell;

/*
 A step for every robot of a team, for one team move.
 */
typedef struct {
  /*
   One of `TAUTLINE_KIND_…`.
   */
  uint32_t kind;
  /*
   How many robots there are, the base counted.
   */
  uint32_t robots;
  /*
   For each robot one of `TAUTLINE_STEP_…`; the base is the first, and stays.
   */
  uint8_t steps[TAUTLINE_CHAIN_ROBOTS];
} TautlinePlan;

/*
 Whether a robot can go between two cells beside each other: any other number than 0 if it can. `context` is what the
 caller gave with the function.
 */
typedef int32_t (*TautlineIsOpen)(void *context, TautlineCell one, TautlineCell other);

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/*
 The status in words, with what to do: a text that ends with a zero byte and stays where it is. Of a number that is
 no status it says so.
 */
const char *tautline_status_text(int32_t status);

/*
 Makes a chain in the caller's memory: `robots`, the base counted, all in the cell `base`. The area goes from the
 cell `first` in the north-west to the cell `last` in the south-east; nothing is known of it but its border.

 # Safety
 `chain` is null, or memory of the caller that nobody else uses meanwhile.
 */
TautlineStatus tautline_chain_begin(TautlineChain *chain,
                                    uint32_t rule,
                                    uint32_t robots,
                                    TautlineCell first,
                                    TautlineCell last,
                                    TautlineCell base);

/*
 Says in `plan` what the team intends. `log` has the messages of all team moves so far, as `tautline_chain_settle`
 wrote them. When the run is over, the status says how it ended, and `plan` stays as it was.

 # Safety
 `chain` and `plan` are null, or memory of the caller that nobody else uses meanwhile; `log` has so many bytes.
 */
TautlineStatus tautline_chain_plan(TautlineChain *chain,
                                   const uint8_t *log,
                                   size_t log_bytes,
                                   TautlinePlan *plan);

/*
 Carries the plan out. `is_open` answers for every pair of cells that a robot goes between for the first time, once
 each, in the order of the robots. The messages of the robots behind the base, one byte each, go to `messages`, and
 their number to `sent`: the caller appends them to the log.

 # Safety
 `chain` is null, or memory of the caller that nobody else uses meanwhile; `messages` has room for `capacity` bytes;
 `is_open` returns, and does not use `chain`.
 */
TautlineStatus tautline_chain_settle(TautlineChain *chain,
                                     TautlineIsOpen is_open,
                                     void *context,
                                     uint8_t *messages,
                                     size_t capacity,
                                     size_t *sent);

/*
 Carries the plan out as a robot that plans along and hears of the rest (CHAIN-8): `messages` has one byte of each
 robot but the base about this team move. A message that cannot be about it is refused, and the plan is still to be
 settled.

 # Safety
 `chain` is null, or memory of the caller that nobody else uses meanwhile; `messages` has so many bytes.
 */
TautlineStatus tautline_chain_hear(TautlineChain *chain,
                                   const uint8_t *messages,
                                   size_t message_bytes);

/*
 Writes to `cells` where the robots are, the base first and the leader last, and their number to `robots`.

 # Safety
 `chain` is null, or a chain that nobody changes meanwhile; `cells` has room for `capacity` cells.
 */
TautlineStatus tautline_chain_cells(const TautlineChain *chain,
                                    TautlineCell *cells,
                                    size_t capacity,
                                    size_t *robots);

/*
 Writes to `is_explored` 1 if a robot has been in the cell, or if it is outside the area, else 0.

 # Safety
 `chain` is null, or a chain that nobody changes meanwhile; `is_explored` is null or the caller's own.
 */
TautlineStatus tautline_chain_is_explored(const TautlineChain *chain,
                                          TautlineCell asked,
                                          uint8_t *is_explored);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* TAUTLINE_H */
