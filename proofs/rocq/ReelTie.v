(** The tie between the kernel's reel and Reel.v.

    A run of the kernel is given by its walls, by the bytes that the robots sent, by the measure when each team move was
    planned and when it was made, and by what was rehearsed, team move by team move, when a task was begun. Each team
    move must be one that Reel.v has, with this measure; each rehearsal must be one on the map known by then; and as
    long as nothing is gained each team move of a task must be that of the rehearsal. *)
From Coq Require Import ZArith NArith Lia Bool List Arith.
From Tautline Require Import Lattice Rule Team Message Replay Heard Reach Replayed Reel Scripts.
From Tautline.generated Require Import ReelRuns.
Import ListNotations.

Definition told : Type := N * N * N * list N.
Definition reel_of_kernel : Type := nat * cell * list edge * list edge * list told * list cell.

(** The kernel's measure in one number: take-backs begun, whether one is under way, team moves left. *)
Definition measure_of (k : N) : nat * nat * nat :=
  (255 - N.to_nat (N.shiftr k 20), N.to_nat (N.land (N.shiftr k 16) 15), N.to_nat (N.land k 65535)).
Definition same_measure (a b : nat * nat * nat) : bool :=
  let '(a1, a2, a3) := a in let '(b1, b2, b3) := b in (a1 =? b1) && (a2 =? b2) && (a3 =? b3).
Definition same_move (a b : team_move) : bool :=
  match a, b with
  | Advance l, Advance m | Backtrack l, Backtrack m => list_eqb step_eqb l m
  | _, _ => false
  end.

Section Kernel.
  Variables (N : nat) (rl : rule) (base : cell) (walls known : list edge).

  Notation reel := (reel script).
  Notation moves := (moves N rl base walls ALL script (follows N rl base)).

  (** What the robots say after a team move of the reel, and its measure before and after. *)
  Definition is_told (x : reel) (mv : team_move) (m : memory script) (y : reel) (e : told) : bool :=
    let '(number, before, made, _) := e in
    match decoded (bytes (pred N) number) with
    | Some l =>
        match team_move_of l with
        | Some mv' =>
            same_move mv mv' && match mv with Backtrack _ => true | Advance _ => says_so N walls (team_at x) l end
        | None => false
        end
    | None => false
    end && same_measure (measure m) (measure_of before) && same_measure (measure (mind y)) (measure_of made).

  Inductive story : reel -> list told -> reel -> Prop :=
  | story_ends : forall x, story x [] x
  | story_goes : forall x mv m y e l z, moves x mv m y -> is_told x mv m y e = true -> story y l z ->
      story x (e :: l) z.

  Definition steps_of (number : BinNums.N) : option (list step) :=
    option_map (fun l => Stay :: map fst l) (decoded (bytes (pred N) number)).
  Fixpoint script_of (l : list BinNums.N) : option script :=
    match l with
    | [] => Some []
    | number :: l => match steps_of number, script_of l with Some pl, Some t => Some (pl :: t) | _, _ => None end
    end.

  (** Which team move of Reel.v it must be. *)
  Definition said_of (x : reel) (e : told) : option said :=
    let '(number, before, _, rehearsed) := e in
    match option_map team_move_of (decoded (bytes (pred N) number)), measure_of before with
    | Some (Some (Backtrack _)), _ => Some (match is_at (remembers x) with TakingBack (S _) => BackOn | _ => Back end)
    | Some (Some (Advance pl)), (_, _, O) => Some (Touch pl)
    | Some (Some (Advance _)), _ =>
        match rehearsed with [] => Some On | _ :: _ => option_map Begin (script_of rehearsed) end
    | _, _ => None
    end.

  Fixpoint told_all (x : reel) (l : list told) : option reel :=
    match l with
    | [] => Some x
    | e :: l =>
        match said_of x e with
        | Some s =>
            match plays N rl base walls ALL x s with
            | Some (mv, m, y) => if is_told x mv m y e then told_all y l else None
            | None => None
            end
        | None => None
        end
    end.

  Lemma told_story : forall l x z, told_all x l = Some z -> story x l z.
  Proof.
    induction l as [|e l IH]; intros x z E; cbn in E; [injection E as <-; constructor|].
    destruct (said_of x e) as [s|]; [|discriminate].
    destruct (plays _ _ _ _ _ _ _) as [[[mv m] y]|] eqn:P; [|discriminate].
    destruct (is_told x mv m y e) eqn:T; [|discriminate].
    econstructor; [eapply plays_moves; exact P | exact T | now apply IH].
  Qed.
End Kernel.

Definition reels_of_kernel : list (rule * list reel_of_kernel) := [(REEL, reels_REEL); (REPAIRED, reels_UNHELD)].

Definition is_reel (rl : rule) (r : reel_of_kernel) : bool :=
  let '(n, base, inside, border, l, last) := r in
  match told_all n rl base (inside ++ border) (begins n base border script) l with
  | Some x => list_eqb cell_eqb (places (team_at x)) last
  | None => false
  end.

Lemma all_are_reels : forallb (fun rs => forallb (is_reel (fst rs)) (snd rs)) reels_of_kernel = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

(** Every run of the kernel's reel, with Hold and without, is one of Reel.v: it says the same, has the same measure when
    each team move is planned and when it is made, and ends where the kernel has the robots. *)
Theorem kernel_reels_run : forall rl rs n base inside border l last, In (rl, rs) reels_of_kernel ->
  In (n, base, inside, border, l, last) rs ->
  exists x, story n rl base (inside ++ border) (begins n base border script) l x /\ places (team_at x) = last.
Proof.
  intros rl rs n base inside border l last I J; pose proof all_are_reels as A. rewrite forallb_forall in A;
    specialize (A _ I); cbn [fst snd] in A. rewrite forallb_forall in A; specialize (A _ J). unfold is_reel in A.
  destruct (told_all _ _ _ _ _ _) as [x|] eqn:E; [|discriminate]. apply list_eqb_cells in A.
  exists x; split; [now apply told_story | exact A].
Qed.
