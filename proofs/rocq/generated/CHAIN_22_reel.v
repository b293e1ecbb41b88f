(** What the kernel answers, written by `ROCQ_UPDATE=always cargo test -p tautline-proofs --test all rocq`. Do not edit. *)
From Coq Require Import ZArith NArith List.
Import ListNotations.

From Coq Require Import ZArith NArith List.
From Tautline Require Import Certificate.
Import ListNotations.
Local Open Scope Z_scope.

Definition rule_ : rule := {|
 robots := 2; colours := 1; reach := 2; far := false; width := 2;
 moves :=
 [[((1, 0), [(true, 0%nat); (false, 0%nat)]);
  ((0, 1), [(true, 0%nat); (false, 0%nat)]);
  ((-1, 0), [(true, 0%nat); (false, 0%nat)]);
  ((0, -1), [(true, 0%nat); (false, 0%nat)]);
  ((0, 0), [(true, 0%nat)]);
  ((1, 0), [(true, 0%nat); (false, 0%nat)]);
  ((0, 1), [(true, 0%nat); (false, 0%nat)]);
  ((-1, 0), [(true, 0%nat); (false, 0%nat)]);
  ((0, -1), [(true, 0%nat); (false, 0%nat)]);
  ((1, 0), [(true, 0%nat); (false, 0%nat)]);
  ((0, 1), [(true, 0%nat); (false, 0%nat)]);
  ((-1, 0), [(true, 0%nat); (false, 0%nat)]);
  ((0, -1), [(true, 0%nat); (false, 0%nat)]);
  ((0, 0), [(true, 0%nat)])]];
 admitted :=
 Node [Node [Leaf 0x23880%N;
 Leaf 0x239800%N;
 Leaf 0xe70000%N;
 Leaf 0x8e3000%N;
 Leaf 0xe73800%N;
 Leaf 0x23880%N;
 Leaf 0x239800%N;
 Leaf 0xe70000%N;
 Leaf 0x8e3000%N];
 Node [Leaf 0x3388%N;
 Leaf 0x23880%N;
 Leaf 0x8e3000%N;
 Leaf 0xc6300%N;
 Leaf 0xe7380%N;
 Leaf 0x3388%N;
 Leaf 0x23880%N;
 Leaf 0x8e3000%N;
 Leaf 0xc6300%N];
 Node [Leaf 0x1ce%N;
 Leaf 0x18e2%N;
 Leaf 0x23880%N;
 Leaf 0x3388%N;
 Leaf 0x39ce%N;
 Leaf 0x1ce%N;
 Leaf 0x18e2%N;
 Leaf 0x23880%N;
 Leaf 0x3388%N];
 Node [Leaf 0x18e2%N;
 Leaf 0x18c60%N;
 Leaf 0x239800%N;
 Leaf 0x23880%N;
 Leaf 0x39ce0%N;
 Leaf 0x18e2%N;
 Leaf 0x18c60%N;
 Leaf 0x239800%N;
 Leaf 0x23880%N];
 Node [Leaf 0x39c4%N;
 Leaf 0x31cc0%N;
 Leaf 0x473800%N;
 Leaf 0x67180%N;
 Leaf 0x739c0%N;
 Leaf 0x39c4%N;
 Leaf 0x31cc0%N;
 Leaf 0x473800%N;
 Leaf 0x67180%N];
 Node [Leaf 0x23880%N;
 Leaf 0x239800%N;
 Leaf 0xe70000%N;
 Leaf 0x8e3000%N;
 Leaf 0xe73800%N;
 Leaf 0x23880%N;
 Leaf 0x239800%N;
 Leaf 0xe70000%N;
 Leaf 0x8e3000%N];
 Node [Leaf 0x3388%N;
 Leaf 0x23880%N;
 Leaf 0x8e3000%N;
 Leaf 0xc6300%N;
 Leaf 0xe7380%N;
 Leaf 0x3388%N;
 Leaf 0x23880%N;
 Leaf 0x8e3000%N;
 Leaf 0xc6300%N];
 Node [Leaf 0x1ce%N;
 Leaf 0x18e2%N;
 Leaf 0x23880%N;
 Leaf 0x3388%N;
 Leaf 0x39ce%N;
 Leaf 0x1ce%N;
 Leaf 0x18e2%N;
 Leaf 0x23880%N;
 Leaf 0x3388%N];
 Node [Leaf 0x18e2%N;
 Leaf 0x18c60%N;
 Leaf 0x239800%N;
 Leaf 0x23880%N;
 Leaf 0x39ce0%N;
 Leaf 0x18e2%N;
 Leaf 0x18c60%N;
 Leaf 0x239800%N;
 Leaf 0x23880%N];
 Node [Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x23880%N;
 Leaf 0x31800%N;
 Leaf 0x71000%N;
 Leaf 0x63000%N;
 Leaf 0x473880%N];
 Node [Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x3180%N;
 Leaf 0x23880%N;
 Leaf 0x63000%N;
 Leaf 0x43100%N;
 Leaf 0x67980%N];
 Node [Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x11c0%N;
 Leaf 0x18c0%N;
 Leaf 0x23880%N;
 Leaf 0x3180%N;
 Leaf 0x239c4%N];
 Node [Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x18c0%N;
 Leaf 0x11840%N;
 Leaf 0x31800%N;
 Leaf 0x23880%N;
 Leaf 0x33cc0%N];
 Node [Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x239c4%N;
 Leaf 0x33cc0%N;
 Leaf 0x473880%N;
 Leaf 0x67980%N;
 Leaf 0x477dc4%N]];
 promised :=
 Node [Node [Leaf 0x477dc4%N]];
 started :=
 Node [Node [Leaf 0x1000%N]] |}.

Definition certificate_ : certificate := {| window := 2; kept :=
 Node [Node [Leaf 0x477dc4%N]] |}.

Theorem accepted : accepts rule_ certificate_ = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

Theorem holds_ : holds rule_.
Proof. exact (sound rule_ certificate_ accepted). Qed.
