(** Every condition of the chain is needed: with one taken out, a team comes where CHAIN-1, CHAIN-2 or CHAIN-3
    forbids.

    Each theorem is a counterexample that begins in the base: plans that the weaker rule admits, in a layout
    with at most three walls. Each run is checked by computation, and Replay.v shows that what the check accepts
    can be reached. *)
From Coq Require Import ZArith Lia Bool List Arith.
From Tautline Require Import Lattice Rule Team Replay.
Import ListNotations.
Local Open Scope Z_scope.

Definition e := Cross East.
Definition s := Cross South.
Definition w := Cross West.
Definition n := Cross North.
Definition o := Stay.

(** The places that a team comes to. *)
Fixpoint follow (N : nat) (rl : rule) (walls : list edge) (t : listed) (plans : list (list step)) : option listed :=
  match plans with
  | [] => Some t
  | pl :: plans => match next N rl (0, 0) walls t (Advance pl) with Some t => follow N rl walls t plans | None =>
    None end
  end.

Definition comes_to (N : nat) (rl : rule) (walls : list edge) (plans : list (list step)) : option (list cell) :=
  option_map places (follow N rl walls (list_start N (0, 0)) plans).

Lemma follow_reachable : forall N rl walls plans t t', reachable N rl (0, 0) (stands walls) (state_of t) ->
  follow N rl walls t plans = Some t' -> reachable N rl (0, 0) (stands walls) (state_of t').
Proof.
  intros N rl walls plans; induction plans as [|pl plans IH]; intros t t' R E; cbn [follow] in E;
    [now injection E as <-|].
  destruct (next N rl (0, 0) walls t (Advance pl)) as [u|] eqn:X; [|discriminate].
  eapply IH; [|exact E]. eapply next_reachable; eauto.
Qed.

Lemma comes_to_reachable : forall N rl walls plans cells, comes_to N rl walls plans = Some cells ->
  exists st, reachable N rl (0, 0) (stands walls) st /\ pos st = team_of cells.
Proof.
  intros N rl walls plans cells E; unfold comes_to in E.
  destruct (follow _ _ _ _ _) as [t|] eqn:F; [|discriminate]; injection E as <-.
  exists (state_of t); split; [|reflexivity]. eapply follow_reachable; [|exact F].
  eexists; apply run_start, alike_start.
Qed.

Ltac by_run N rl walls plans :=
  let r := eval vm_compute in (comes_to N rl walls plans) in
  match r with Some ?cells =>
    let st := fresh in let R := fresh in let E := fresh in
    destruct (comes_to_reachable N rl walls plans cells) as [st [R E]]; [vm_compute; reflexivity|];
    exists N, (stands walls), st; split; [exact R | unfold occupants; rewrite E; vm_compute; reflexivity]
  end.

Definition breaks_CHAIN_1 (rl : rule) : Prop :=
  exists N wall st, reachable N rl (0, 0) wall st /\
    existsb (fun i => negb (covers COVERED (pos st i) (pos st (S i)))) (seq 0 (pred N)) = true.

Definition breaks_CHAIN_2 (rl : rule) : Prop :=
  exists N wall st, reachable N rl (0, 0) wall st /\
    existsb (fun i => negb (cell_eqb (pos st i) (0, 0)) && (2 <? occupants N (pos st) (pos st i))%nat) (seq 0 N) = true.

Definition breaks_CHAIN_3 (rl : rule) : Prop :=
  exists N wall st, reachable N rl (0, 0) wall st /\
    existsb (fun i => negb (reaches COVERED (pos st i) (pos st (S i)))) (seq 0 (pred N)) = true.

(** Three robots and one wall. *)
Theorem published_breaks_CHAIN_1 : breaks_CHAIN_1 PUBLISHED.
Proof. by_run 3%nat PUBLISHED [((1, 0), false)] [[o; o; s]; [o; o; e]; [o; n; n]]. Qed.
Theorem without_UnsureAhead_breaks_CHAIN_1 : breaks_CHAIN_1 without_UnsureAhead.
Proof. by_run 3%nat without_UnsureAhead [((1, 0), false)] [[o; o; s]; [o; o; e]; [o; n; n]]. Qed.
(** Three robots, no wall. *)
Theorem without_SafeAhead_breaks_CHAIN_1 : breaks_CHAIN_1 without_SafeAhead.
Proof. by_run 3%nat without_SafeAhead (@nil edge) [[o; o; e]; [o; o; s]; [o; w; o]]. Qed.
Theorem without_SafeAhead_breaks_CHAIN_3 : breaks_CHAIN_3 without_SafeAhead.
Proof. by_run 3%nat without_SafeAhead (@nil edge) [[o; o; e]; [o; o; s]; [o; w; o]; [o; w; o]]. Qed.
(** Three robots and one wall. *)
Theorem without_CoveredBehind_breaks_CHAIN_1 : breaks_CHAIN_1 without_CoveredBehind.
Proof. by_run 3%nat without_CoveredBehind [((0, 0), true)] [[o; o; s]; [o; o; e]; [o; e; e]]. Qed.
(** Four robots and three walls. *)
Theorem published_breaks_CHAIN_2 : breaks_CHAIN_2 PUBLISHED.
Proof. by_run 4%nat PUBLISHED [((0, 1), true); ((1, 1), true); ((1, 1), false)] [[o; o; o; e]; [o; o; e; s]; [o; e; s;
  w]; [o; s; s; e]]. Qed.
Theorem without_FullForFollower_breaks_CHAIN_2 : breaks_CHAIN_2 without_FullForFollower.
Proof. by_run 4%nat without_FullForFollower [((0, 1), true); ((1, 1), true); ((1, 1), false)] [[o; o; o; e]; [o; o; e;
  s]; [o; e; s; w]; [o; s; s; e]]. Qed.
Theorem without_FullForLeader_breaks_CHAIN_2 : breaks_CHAIN_2 without_FullForLeader.
Proof. by_run 4%nat without_FullForLeader [((1, 0), false); ((1, 0), true); ((1, -1), false)] [[o; o; e; o]; [o; e; s;
  o]; [o; n; e; e]]. Qed.
(** Four robots, no wall. *)
Theorem without_Distinct_breaks_CHAIN_2 : breaks_CHAIN_2 without_Distinct.
Proof. by_run 4%nat without_Distinct (@nil edge) [[o; e; e; e]]. Qed.

