(** MRC's conditions are needed: without ChoiceStands, Epochs or Consent a rescue comes where MRC-1, MRC-2 or
    MRC-4 forbids.

    Each theorem is a run from the start, whose events are checked by computation. *)
From Coq Require Import List Bool Arith.
From Tautline Require Import Mrc MrcTie.
Import ListNotations.

(** An event, and which of its outcomes comes about. *)
Inductive act :=
| Wfr (w : nat) (i : wfr_input) (k : nat)
| Robot (r : nat) (i : robot_input) (k : nat)
| Both (r : nat) (k : nat).

Definition was_sent (m : message) (s : rescue) : bool :=
  existsb (fun n => if eq_messages [m] [n] then true else false) (sent s).

Lemma was_sent_in : forall m s, was_sent m s = true -> In m (sent s).
Proof.
  intros m s H; apply existsb_exists in H; destruct H as [n [I E]]; destruct (eq_messages [m] [n]) as [[= ->]|];
    congruence.
Qed.

(** Leases that lapse, and robots that come without a lease, occur in none of the runs. *)
Definition wfr_can (s : rescue) (i : wfr_input) : bool :=
  match i with Hears m => was_sent m s | Raised | Expires => true | Reached => false end.
Definition robot_can (s : rescue) (i : robot_input) : bool :=
  match i with Told m => was_sent m s | Waited => true | Arrives | Lapses _ _ => false end.

Definition acted (rl : rule) (s : rescue) (a : act) : option rescue :=
  match a with
  | Wfr w i k =>
      match wfr_can s i, nth_error (wfr_outcomes rl w (wfrs s w) i) k with
      | true, Some (x, out) => Some {| robots := robots s; wfrs := put (wfrs s) w x; sent := out ++ sent s |}
      | _, _ => None
      end
  | Robot r i k =>
      match robot_can s i, nth_error (robot_outcomes rl r (robots s r) i) k with
      | true, Some (x, out) => Some {| robots := put (robots s) r x; wfrs := wfrs s; sent := out ++ sent s |}
      | _, _ => None
      end
  | Both r k =>
      match doing (robots s r) with
      | Leased w _ =>
          match nth_error (robot_outcomes rl r (robots s r) Arrives) k,
            nth_error (wfr_outcomes rl w (wfrs s w) Reached) 0 with
          | Some (x, out), Some (y, none) =>
              Some {| robots := put (robots s) r x; wfrs := put (wfrs s) w y; sent := out ++ none ++ sent s |}
          | _, _ => None
          end
      | Free | Asking _ _ => None
      end
  end.

Fixpoint comes_to (rl : rule) (s : rescue) (acts : list act) : option rescue :=
  match acts with
  | [] => Some s
  | a :: acts => match acted rl s a with Some t => comes_to rl t acts | None => None end
  end.

Lemma acted_event : forall rl s a t, acted rl s a = Some t -> event rl s t.
Proof.
  intros rl s [w i k|r i k|r k] t E; unfold acted in E.
  - destruct (wfr_can s i) eqn:C; [|discriminate].
    destruct (nth_error _ k) as [[x out]|] eqn:N; [|discriminate]; injection E as <-. apply nth_error_In in N.
    apply at_wfr with (i := i); [|exact N]. destruct i; cbn in *; auto; [now apply was_sent_in | discriminate].
  - destruct (robot_can s i) eqn:C; [|discriminate].
    destruct (nth_error _ k) as [[x out]|] eqn:N; [|discriminate]; injection E as <-. apply nth_error_In in N.
    apply at_robot with (i := i); [|exact N]. destruct i; cbn in *; auto; try discriminate. now apply was_sent_in.
  - destruct (doing (robots s r)) as [|w e|w e] eqn:D; try discriminate.
    destruct (nth_error (robot_outcomes rl r (robots s r) Arrives) k) as [[x out]|] eqn:N; [|discriminate].
    destruct (nth_error (wfr_outcomes rl w (wfrs s w) Reached) 0) as [[y none]|] eqn:M; [|discriminate].
    injection E as <-. apply nth_error_In in N, M. now apply at_both with (e := e).
Qed.

Lemma comes_to_reached : forall rl acts s t, reached rl s -> comes_to rl s acts = Some t -> reached rl t.
Proof.
  intros rl acts; induction acts as [|a acts IH]; intros s t R E; cbn [comes_to] in E; [now injection E as <-|].
  destruct (acted rl s a) as [u|] eqn:A; [|discriminate]. eapply IH; [|exact E].
  eapply reached_event; [exact R | now apply acted_event with (a := a)].
Qed.

(** What the run comes to has the property, by computation. *)
Lemma by_run : forall rl acts (P : rescue -> Prop),
  match comes_to rl nothing_yet acts with Some t => P t | None => False end -> exists s, reached rl s /\ P s.
Proof.
  intros rl acts P H; destruct (comes_to rl nothing_yet acts) as [t|] eqn:E; [|contradiction].
  exists t; split; [|exact H]. eapply comes_to_reached; [apply reached_start | exact E].
Qed.

(** WFR [w] calls, robot [r] hears it and asks, and the WFR chooses it. *)
Definition chosen (w r : nat) : list act :=
  [Wfr w Raised 0; Robot r (Told (Notice w 1)) 2; Wfr w (Hears (Move w 1 r)) 0; Wfr w Expires 0].

(** A MOVE after the choice changes it, and two robots set out. *)
Theorem without_ChoiceStands_breaks_MRC_1 : exists s, reached without_ChoiceStands s
  /\ doing (robots s 1) = Leased 1 1 /\ doing (robots s 2) = Leased 1 1.
Proof.
  apply by_run with (acts := chosen 1 1 ++
    [Robot 1 (Told (Resb 1 1 1 (Some 1))) 0;
     Robot 2 (Told (Notice 1 1)) 2; Wfr 1 (Hears (Move 1 1 2)) 1; Robot 2 (Told (Resb 1 1 2 (Some 2))) 0]).
  vm_compute; auto.
Qed.

(** The robot has come. At the next event of the WFR an old MOVE and an old acceptance arrive once more, while
    the robot is on its way to another WFR. *)
Theorem without_Epochs_breaks_MRC_2 : exists s, reached without_Epochs s
  /\ stage (wfrs s 1) = CountsOn 1 /\ stage (wfrs s 2) = CountsOn 1.
Proof.
  apply by_run with (acts := chosen 1 1 ++
    [Robot 1 (Told (Resb 1 1 1 (Some 1))) 0; Wfr 1 (Hears (Accept 1 1 1)) 0; Both 1 0] ++ chosen 2 1 ++
    [Robot 1 (Told (Resb 2 1 1 (Some 1))) 0; Wfr 2 (Hears (Accept 2 1 1)) 0;
     Wfr 1 Raised 0; Wfr 1 (Hears (Move 1 1 1)) 0; Wfr 1 Expires 0; Wfr 1 (Hears (Accept 1 1 1)) 0]).
  vm_compute; auto.
Qed.

(** The WFR counts on the robot before the robot knows of it. *)
Theorem without_Consent_breaks_MRC_4 : exists s, reached without_Consent s
  /\ stage (wfrs s 1) = CountsOn 1 /\ doing (robots s 1) = Asking 1 1.
Proof. apply by_run with (acts := chosen 1 1). vm_compute; auto. Qed.
