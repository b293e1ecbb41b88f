(** The condition Route is needed for FRONTIER-1: a robot that looks at the cells beside its own alone, as published, ends
    with a cell left. The condition Return is needed for FRONTIER-13: a robot that does not ask its map again at the rim
    enters what another one has explored. *)
From Coq Require Import Lia Bool List Arith.
From Tautline Require Import Explorers ExplorersEnd ExplorersOnce ExplorersTie.
Import ListNotations.

Definition beside_alone : rule nat :=
  {| chooses := fun _ r => map (fun v => (v, v))
       (filter (fun v => negb (has nat Nat.eqb (explored r) v) && negb (has nat Nat.eqb (blocked r) v)) (beside 3 1 (place r)));
     claims := false; returns := true |}.

(** Three cells in a row, and the robot begins in the middle: it goes west. *)
Definition story_ : story := [([(0, 0); (0, 2)], false, Decides 0 0 0 []); ([], false, Looks 0 [] [] 0); ([], false, Arrives 0 [])].

Theorem without_Route_breaks_FRONTIER_1 : exists w, run nat Nat.eqb (cells 3 1) (obstacle []) 1 beside_alone w
  /\ ended nat Nat.eqb (obstacle []) 1 beside_alone w
  /\ joined nat (beside 3 1) (obstacle []) (place (robots w 0)) 2 /\ ~ In 2 (been w).
Proof.
  destruct (replay [] 1 beside_alone (begins_in 1 [1]) story_) as [w|] eqn:E; [|vm_compute in E; discriminate].
  exists w; split; [eapply replay_runs; [apply (begins_runs 3 1 [] 1 beside_alone [1]); reflexivity | exact E]|].
  assert (is_over 1 beside_alone w && (place (robots w 0) =? 0) && negb (existsb (Nat.eqb 2) (been w)) = true) as H
    by (vm_compute in E; injection E as <-; vm_compute; reflexivity).
  rewrite !andb_true_iff, negb_true_iff, Nat.eqb_eq in H; destruct H as [[O P] B].
  split; [eapply over_ended; exact O|]; split.
  - rewrite P; apply joined_over with (v := 1); [apply joined_over with (v := 0); [apply joined_self | cbn; auto | reflexivity] | cbn; auto | reflexivity].
  - intros I; apply not_true_iff_false in B; apply B; apply existsb_exists; exists 2; auto.
Qed.

Definition without_Return : rule nat :=
  let r := repaired 5 1 2 in {| chooses := chooses r; claims := claims r; returns := false |}.

(** Five cells in a row, and two robots in the third and the last one: one explores the cell between them and goes back,
    while the other one is at its rim. *)
Definition before_the_look : list (event nat) :=
  [Decides 0 3 3 []; Looks 0 [] [] 0; Decides 1 3 3 []; Arrives 0 []; Decides 0 2 1 []; Looks 0 [] [] 0; Arrives 0 []].
Definition step_ (w : option (world nat)) (e : event nat) : option (world nat) :=
  match w with
  | Some w => match next nat Nat.eqb (obstacle []) 2 without_Return w e with Some x => Some (listed 2 x) | None => None end
  | None => None
  end.
Notation heard := (heard_run nat Nat.eqb (cells 5 1) (obstacle []) 2 without_Return).

Lemma steps_heard : forall es w x, heard w -> forallb (fun e => negb (missed nat e)) es = true ->
  fold_left step_ es (Some w) = Some x -> heard x.
Proof.
  assert (forall es, fold_left step_ es None = None) as No by (induction es; auto).
  induction es as [|e es IH]; intros w x H M E; [now injection E as <-|]. cbn [fold_left step_] in E.
  cbn [forallb] in M; apply andb_true_iff in M; destruct M as [M Ms]; apply negb_true_iff in M.
  destruct (next _ _ _ _ _ w e) as [y|] eqn:X; [|now rewrite No in E].
  eapply IH; [|exact Ms | exact E]. eapply heard_step; [exact H | exact M|]. exists y; split; [exact X | apply listed_alike].
Qed.

Lemma starts_apart : may_start nat (cells 5 1) (obstacle []) 2 (fun i => nth i [2; 4] 0).
Proof.
  split; [intros [|[|i]] I; [cbn; auto 9 | cbn; auto 9 | lia]|].
  intros [|[|i]] [|[|j]] I J Q; cbn in Q; try reflexivity; try discriminate; lia.
Qed.
Lemma enters_again : match fold_left step_ before_the_look (Some (begins_in 2 [2; 4])) with
  | Some w => match next nat Nat.eqb (obstacle []) 2 without_Return w (Looks 1 [] [] 0) with
      | Some x => match doing (robots x 1) with Enters v => v =? 3 | _ => false end
          && match aim (robots x 1) with Some c => c =? 3 | None => false end && existsb (Nat.eqb 3) (been w)
      | None => false end
  | None => false end = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

Theorem without_Return_breaks_FRONTIER_13 : exists w w', heard w
  /\ leads nat Nat.eqb (obstacle []) 2 without_Return w (Looks 1 [] [] 0) w'
  /\ doing (robots w' 1) = Enters 3 /\ aim (robots w' 1) = Some 3 /\ In 3 (been w).
Proof.
  pose proof enters_again as H; destruct (fold_left _ _ _) as [w|] eqn:E; [|discriminate H].
  destruct (next _ _ _ _ _ w _) as [x|] eqn:X; [|discriminate H].
  rewrite !andb_true_iff in H; destruct H as [[D A] B].
  exists w, x; split; [|split; [exists x; split; [exact X | repeat split]|split; [|split]]].
  - apply (steps_heard before_the_look (begins_in 2 [2; 4])); [|reflexivity | exact E].
    eapply heard_start; [exact starts_apart | repeat split].
  - clear - D; destruct (doing _); try discriminate; apply Nat.eqb_eq in D; now subst.
  - clear - A; destruct (aim _); [|discriminate]; apply Nat.eqb_eq in A; now subst.
  - clear - B; apply existsb_exists in B; destruct B as [v [I B]]; apply Nat.eqb_eq in B; now subst.
Qed.
