(** MRC, repaired, after section 3.3 of [Jiang 2011]: any number of robots and of nodes that wait for rescue
    (WFRs), any number of events and of calls, and a network that delays, loses, repeats and reorders messages
    as it likes.

    Leases.v speaks of this file. A robot and a WFR are functions from what they are and what happens to the
    list of what may come of it, as in kernel/src/mrc/robot.rs and wfr.rs; where the kernel decides (the nearest
    call, the best bid, whose record makes room), the list has every decision. Hop counts and parents are left
    out. MrcTie.v shows that whatever the kernel's robots and WFRs do in a table of situations is in these
    lists.

    Whatever was sent may arrive at any time, again, late or never. Timers go off at any time, too, with one
    exception, which SPEC.md names: a robot's lease does not lapse while its WFR waits for it. *)
From Coq Require Import List Bool Arith.
Import ListNotations.

(** The conditions that the clauses of Leases.v need, as in kernel/src/mrc/rule.rs; the others are in force or
    play no part. *)
Record rule := {
  (** A MOVE after the choice does not change it. *)
  choice_stands : bool;
  (** What belongs to another epoch is ignored. *)
  epochs : bool;
  (** The robot chosen accepts or declines, and the WFR counts on it when it has accepted. *)
  consent : bool;
}.

Definition REPAIRED : rule := Build_rule true true true.
Definition without_ChoiceStands : rule := Build_rule false true true.
Definition without_Epochs : rule := Build_rule true false true.
Definition without_Consent : rule := Build_rule true true false.

(** WFRs, robots and epochs have numbers. [Resb w e r c]: WFR [w] tells robot [r] that for its call [e] it has
    chosen [c]. *)
Inductive message :=
| Notice (w e : nat)
| Move (w e r : nat)
| Resb (w e to : nat) (chosen : option nat)
| Accept (w e r : nat)
| Decline (w e r : nat).

(** ** A WFR *)

Inductive phase :=
| Idle
| Collecting (best : option nat)
| Offered (choice : nat)
| CountsOn (choice : nat)
| Rescued.

(** The number of its call, how far it is, and who has asked. *)
Record wfr := { call : nat; stage : phase; asked : list nat }.

Inductive wfr_input := Raised | Hears (m : message) | Expires | Reached.

Definition renewed (w : nat) (x : wfr) : wfr * list message :=
  ({| call := S (call x); stage := Collecting None; asked := [] |}, [Notice w (S (call x))]).

(** A WFR remembers whom it has heard as long as it has room. *)
Definition remembered (x : wfr) (r : nat) : list (list nat) :=
  if existsb (Nat.eqb r) (asked x) then [asked x] else [asked x ++ [r]; asked x].

Definition tell_all (w : nat) (x : wfr) (c : nat) : list message := map (fun r => Resb w (call x) r (Some c)) (asked x).

Definition choose (rl : rule) (w : nat) (x : wfr) (c : nat) : wfr * list message :=
  ({| call := call x; stage := if consent rl then Offered c else CountsOn c; asked := asked x |}, tell_all w x c).

Definition with_asked (x : wfr) (a : list nat) : wfr := {| call := call x; stage := stage x; asked := a |}.

Definition hears_move (rl : rule) (w : nat) (x : wfr) (r : nat) : list (wfr * list message) :=
  match stage x with
  | Idle => [(x, [])]
  | Collecting best =>
      flat_map (fun a => map (fun b => ({| call := call x; stage := Collecting (Some b); asked := a |}, []))
        match best with Some b => [b; r] | None => [r] end) (remembered x r)
  | Offered c | CountsOn c =>
      if choice_stands rl then [(x, [Resb w (call x) r (Some c)]); (x, [])]
      else flat_map (fun a => let y := with_asked x a in [(y, tell_all w y c); choose rl w y r]) (remembered x r)
  | Rescued => [(x, [Resb w (call x) r None]); (x, [])]
  end.

Definition wfr_outcomes (rl : rule) (w : nat) (x : wfr) (i : wfr_input) : list (wfr * list message) :=
  let is_mine v e := (v =? w) && (negb (epochs rl) || (e =? call x)) in
  match i with
  | Raised =>
      match stage x with
      | Idle => [({| call := call x; stage := Collecting None; asked := [] |}, [Notice w (call x)])]
      | Rescued => [renewed w x]
      | Collecting _ | Offered _ | CountsOn _ => [(x, [])]
      end
  | Hears (Move v e r) => if is_mine v e then hears_move rl w x r else [(x, [])]
  | Hears (Accept v e r) =>
      match stage x with
      | Offered c =>
          if is_mine v e && (c =? r) then [({| call := call x; stage := CountsOn c; asked := asked x |},
            [])] else [(x, [])]
      | Idle | Collecting _ | CountsOn _ | Rescued => [(x, [])]
      end
  | Hears (Decline v e r) =>
      match stage x with
      | Offered c => if is_mine v e && (c =? r) then [renewed w x] else [(x, [])]
      | Idle | Collecting _ | CountsOn _ | Rescued => [(x, [])]
      end
  | Hears (Notice _ _) | Hears (Resb _ _ _ _) => [(x, [])]
  | Expires =>
      match stage x with
      | Idle | Rescued => [(x, [])]
      | Collecting (Some b) => [choose rl w x b]
      | Collecting None | CountsOn _ => [renewed w x]
      | Offered c => [(x, [Resb w (call x) c (Some c)]); renewed w x]
      end
  | Reached =>
      match stage x with
      | Idle | Rescued => [(x, [])]
      | Collecting _ | Offered _ | CountsOn _ => [({| call := call x; stage := Rescued; asked := asked x |}, [])]
      end
  end.

(** ** A robot *)

(** A record of T_REQ: of a WFR the newest call heard, and its SBit. *)
Record request := { wfr_of : nat; epoch : nat; served : bool }.

Inductive task := Free | Asking (w e : nat) | Leased (w e : nat).

Record robot := { requests : list request; doing : task }.

Inductive robot_input := Told (m : message) | Waited | Arrives | Lapses (w e : nat).

Definition about (w : nat) (q : request) : bool := wfr_of q =? w.
Definition record_of (x : robot) (w : nat) : option request := find (about w) (requests x).

Definition change (w : nat) (f : request -> request) (l : list request) : list request :=
  map (fun q => if about w q then f q else q) l.
Definition serve (w : nat) (x : robot) : robot :=
  {| requests := change w (fun q => {| wfr_of := wfr_of q; epoch := epoch q; served := true |}) (requests x);
    doing := doing x |}.
Definition now (x : robot) (t : task) : robot := {| requests := requests x; doing := t |}.

(** A free robot may send MOVE for a call whose SBit is clear. *)
Definition asks (r : nat) (x : robot) : list (robot * list message) :=
  (x, []) ::
  match doing x with
  | Free => flat_map (fun q =>
      match record_of x (wfr_of q) with
      | Some q => if served q then [] else [(now x (Asking (wfr_of q) (epoch q)), [Move (wfr_of q) (epoch q) r])]
      | None => []
      end) (requests x)
  | Asking _ _ | Leased _ _ => []
  end.

(** A robot's own WFR: the record of it makes room for no other. *)
Definition is_own (t : task) (w : nat) : bool :=
  match t with Free => false | Asking v _ | Leased v _ => v =? w end.

(** The lists with [q] in the place of one served record. *)
Fixpoint making_room (own : nat -> bool) (q : request) (l : list request) : list (list request) :=
  match l with
  | [] => []
  | p :: l => (if served p && negb (own (wfr_of p)) then [q :: l] else []) ++ map (cons p) (making_room own q l)
  end.

(** It hears a call that it has no record of: it adds one, in the place of a served one if the table is full, or
    none. *)
Definition adds (x : robot) (q : request) : list robot :=
  map (fun l => {| requests := l; doing := doing x |})
    (requests x :: (requests x ++ [q]) :: making_room (is_own (doing x)) q (requests x)).

Definition notes (rl : rule) (x : robot) (w e : nat) : list robot :=
  match record_of x w with
  | None => adds x {| wfr_of := w; epoch := e; served := false |}
  | Some q =>
      if epochs rl then
        if epoch q <? e then
          [{| requests := change w (fun _ => {| wfr_of := w; epoch := e; served := false |}) (requests x);
              doing := if is_own (doing x) w then Free else doing x |}]
        else [x]
      else [{| requests := change w (fun q => {| wfr_of := w; epoch := max (epoch q) e; served :=
        served q |}) (requests x);
               doing := doing x |}]
  end.

Definition heeds (rl : rule) (r : nat) (x : robot) (w e : nat) (chosen : option nat) : list (robot * list message) :=
  match record_of x w with
  | None => [(x, [])]
  | Some q =>
      if epochs rl && negb (epoch q =? e) then [(x, [])]
      else
        let y := serve w x in
        let is_asking := match doing x with Asking v _ => v =? w | Free | Leased _ _ => false end in
        let is_leased := match doing x with Leased v _ => v =? w | Free | Asking _ _ => false end in
        if match chosen with Some c => c =? r | None => false end then
          let takes := is_asking || negb (consent rl) in
          [(if takes then now y (Leased w e) else y,
            if consent rl then [if takes || is_leased then Accept w e r else Decline w e r] else [])]
        else asks r (if is_asking || (is_leased && negb (consent rl)) then now y Free else y)
  end.

Definition robot_outcomes (rl : rule) (r : nat) (x : robot) (i : robot_input) : list (robot * list message) :=
  match i with
  | Told (Notice w e) => flat_map (asks r) (notes rl x w e)
  | Told (Resb w e to chosen) => if to =? r then heeds rl r x w e chosen else [(x, [])]
  | Told (Move _ _ _) | Told (Accept _ _ _) | Told (Decline _ _ _) => [(x, [])]
  | Waited =>
      match doing x with
      | Asking w e => (x, [Move w e r]) :: asks r (now (serve w x) Free)
      | Free | Leased _ _ => [(x, [])]
      end
  | Arrives =>
      match doing x with
      | Leased _ _ => asks r (now x Free)
      | Free | Asking _ _ => asks r x
      end
  | Lapses w e =>
      match doing x with
      | Leased v f => if (v =? w) && (f =? e) then asks r (now x Free) else [(x, [])]
      | Free | Asking _ _ => [(x, [])]
      end
  end.

(** ** Rescues *)

Record rescue := { robots : nat -> robot; wfrs : nat -> wfr; sent : list message }.

Definition put {A : Type} (f : nat -> A) (n : nat) (x : A) : nat -> A := fun m => if m =? n then x else f m.

(** Whether a WFR waits for the robot that it has chosen. *)
Definition waits (x : wfr) : Prop := match stage x with Offered _ | CountsOn _ =>
  True | Idle | Collecting _ | Rescued => False end.

Definition wfr_may (s : rescue) (i : wfr_input) : Prop :=
  match i with Hears m => In m (sent s) | Raised | Expires => True | Reached => False end.

Definition robot_may (s : rescue) (i : robot_input) : Prop :=
  match i with
  | Told m => In m (sent s)
  | Waited => True
  | Arrives => False
  | Lapses w e => ~ (call (wfrs s w) = e /\ waits (wfrs s w))
  end.

Inductive event (rl : rule) (s : rescue) : rescue -> Prop :=
| at_wfr : forall w i x out, wfr_may s i -> In (x, out) (wfr_outcomes rl w (wfrs s w) i) ->
    event rl s {| robots := robots s; wfrs := put (wfrs s) w x; sent := out ++ sent s |}
| at_robot : forall r i x out, robot_may s i -> In (x, out) (robot_outcomes rl r (robots s r) i) ->
    event rl s {| robots := put (robots s) r x; wfrs := wfrs s; sent := out ++ sent s |}
| at_both : forall r w e x out y none, doing (robots s r) = Leased w e ->
    In (x, out) (robot_outcomes rl r (robots s r) Arrives) -> In (y, none) (wfr_outcomes rl w (wfrs s w) Reached) ->
    event rl s {| robots := put (robots s) r x; wfrs := put (wfrs s) w y; sent := out ++ none ++ sent s |}.

Definition nothing_yet : rescue :=
  {| robots := fun _ => {| requests := []; doing := Free |};
     wfrs := fun _ => {| call := 1; stage := Idle; asked := [] |};
     sent := [] |}.

Inductive reached (rl : rule) : rescue -> Prop :=
| reached_start : reached rl nothing_yet
| reached_event : forall s s', reached rl s -> event rl s s' -> reached rl s'.
